// SPDX-License-Identifier: MIT
// Faces with holes, which a bridge edge reaches: triangulated and split into convex parts like others.

#include <brep/split.hpp>

#include <optional>

#include <brep/testing.hpp>
#include <brep/triangulate.hpp>

#include "outlines.hpp"
#include "shapes.hpp"

using namespace brep;
using outlines::Points;
using shapes::Mesh;

namespace {

// An outline and its holes, all counter-clockwise.
struct Plate {
  Points outline;
  std::vector<Points> holes;
};

// One shell each. Face 0 is the front of the outline; the front of a hole is a lid in it, and its back is to be bridged.
Mesh shells_of(const Plate& plate) {
  Builder b;
  const auto pillow = [&](const Points& points) {
    std::vector<std::uint32_t> front, back;
    for (const glm::dvec2& p : points) {
      front.push_back(b.vertex({p.x, p.y, 0.0}));
      back.insert(back.begin(), front.back());
    }
    b.face(front, 0);
    b.face(back, 0);
  };
  pillow(plate.outline);
  for (const Points& hole : plate.holes) { pillow(hole); }
  return shapes::build(b);
}
FaceId back_of_hole(std::size_t i) { return FaceId{static_cast<std::uint32_t>(2 * i + 3)}; }

HalfedgeId corner_at(const Mesh& m, FaceId f, const glm::dvec2& p) {
  for (HalfedgeId h : halfedges_of(m, f)) {
    if (glm::dvec2(m.data(m.vertex(h)).position) == p) { return h; }
  }
  return {};
}
void bridge_at(Mesh& m, std::size_t hole, const glm::dvec2& from, const glm::dvec2& to) {
  REQUIRE(bridge(m, corner_at(m, FaceId{0}, from), corner_at(m, back_of_hole(hole), to)));
}

double area_of(const Plate& plate) {
  const auto signed_area = [](const Points& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec2 a = p[i], b = p[(i + 1) % p.size()];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
  };
  double sum = signed_area(plate.outline);
  for (const Points& hole : plate.holes) { sum -= signed_area(hole); }
  return sum;
}

// Both ways to take face 0 apart.
void check_whole(const Mesh& m, double whole) {
  const std::size_t n = degree(m, FaceId{0});
  Mesh triangulated = m, split = m;
  const auto parts = triangulate_face(triangulated, FaceId{0});
  if (!parts) { UNSCOPED_INFO(parts.refusal().sentence()); }
  REQUIRE(parts);
  CHECK(parts->size() == n - 2);
  for (FaceId f : *parts) { CHECK(degree(triangulated, f) == 3); }
  outlines::check_cover(triangulated, *parts, whole, {0, 0, 1});
  CHECK_THAT(triangulated, IsValid());

  const auto convex = split_until_convex(split, FaceId{0});
  if (!convex) { UNSCOPED_INFO(convex.refusal().sentence()); }
  REQUIRE(convex);
  CHECK(convex->size() <= parts->size());
  for (FaceId f : *convex) { CHECK(is_convex(split, f)); }
  outlines::check_cover(split, *convex, whole, {0, 0, 1});
  CHECK_THAT(split, IsValid());
}

Points rectangle(const glm::dvec2& lo, const glm::dvec2& hi) { return {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}; }

// A bridge to the hole that touches nothing on its way, between random corners.
std::optional<std::pair<HalfedgeId, HalfedgeId>> free_bridge(const Mesh& m, std::size_t hole, shapes::Random& random) {
  const auto at = [&](VertexId v) { return glm::dvec2(m.data(v).position); };
  const auto left = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const auto in_cone = [&](HalfedgeId h, const glm::dvec2& p) {
    const glm::dvec2 before = at(m.vertex(m.prev(h))), here = at(m.vertex(h)), after = at(m.target(h));
    const bool past = left(here, after, p) > 0.0, short_of = left(before, here, p) > 0.0;
    return left(before, here, after) >= 0.0 ? past && short_of : past || short_of;
  };
  const auto starts = detail::loop_of(m, FaceId{0}), ends = detail::loop_of(m, back_of_hole(hole));
  for (int attempt = 0; attempt < 2000; ++attempt) {
    const HalfedgeId a = starts[random.below(starts.size())], c = ends[random.below(ends.size())];
    const glm::dvec2 p = at(m.vertex(a)), q = at(m.vertex(c));
    bool clear = in_cone(a, q) && in_cone(c, p);
    for (EdgeId e : edges(m)) {
      const VertexId v = m.vertex(halfedge(e)), w = m.target(halfedge(e));
      if (v == m.vertex(a) || v == m.vertex(c) || w == m.vertex(a) || w == m.vertex(c)) { continue; }
      clear = clear && !(left(p, q, at(v)) * left(p, q, at(w)) <= 0.0 && left(at(v), at(w), p) * left(at(v), at(w), q) <= 0.0);
    }
    if (clear) { return std::pair{a, c}; }
  }
  return std::nullopt;
}

Code refused(const Points& points) {
  Mesh m = shapes::build(shapes::pillow_builder(points));
  const auto before = shapes::records(m);
  const Refusal refusal = triangulate_face(m, FaceId{0}).refusal();
  CHECK(split_until_convex(m, FaceId{0}).refusal().code == refusal.code);
  CHECK(shapes::records(m) == before);
  return refusal.code;
}

}  // namespace

TEST_CASE("a square with a square hole on a bridge: ten corners, eight triangles, whichever corners the bridge joins") {
  const Plate plate{rectangle({0, 0}, {1, 1}), {rectangle({0.25, 0.25}, {0.75, 0.75})}};
  for (const auto& [from, to] :
       {std::pair{glm::dvec2{0, 0}, glm::dvec2{0.25, 0.25}}, std::pair{glm::dvec2{0, 0}, glm::dvec2{0.75, 0.25}},
        std::pair{glm::dvec2{1, 1}, glm::dvec2{0.75, 0.75}}, std::pair{glm::dvec2{0, 1}, glm::dvec2{0.25, 0.25}}}) {
    Mesh m = shells_of(plate);
    bridge_at(m, 0, from, to);
    REQUIRE(degree(m, FaceId{0}) == 10);
    check_whole(m, 0.75);
  }
}

TEST_CASE("a row of square holes, each bridged to the one before along the line of their edges, and two bridges in one corner") {
  Plate plate{rectangle({0, 0}, {11, 3}), {}};
  for (int i = 0; i < 5; ++i) { plate.holes.push_back(rectangle({2.0 * i + 1.0, 1.0}, {2.0 * i + 2.0, 2.0})); }
  Mesh row = shells_of(plate);
  bridge_at(row, 0, {0, 0}, {1, 1});
  for (std::size_t i = 1; i < 5; ++i) { bridge_at(row, i, {2.0 * static_cast<double>(i), 1.0}, {2.0 * static_cast<double>(i) + 1.0, 1.0}); }
  check_whole(row, 28.0);

  const Plate fan{rectangle({0, 0}, {4, 4}), {rectangle({1, 2}, {2, 3}), rectangle({2, 1}, {3, 1.5})}};
  Mesh m = shells_of(fan);
  bridge_at(m, 0, {0, 0}, {1, 2});
  const HalfedgeId first = corner_at(m, FaceId{0}, {0, 0});  // two corners are there now: the one below the first bridge is meant
  HalfedgeId below = first;
  for (HalfedgeId h : halfedges_of(m, FaceId{0})) {
    if (m.vertex(h) == m.vertex(first) && m.data(m.target(h)).position == glm::dvec3{4, 0, 0}) { below = h; }
  }
  REQUIRE(bridge(m, below, corner_at(m, back_of_hole(1), {2, 1})));
  check_whole(m, 14.5);
}

TEST_CASE("random plates with random holes on random bridges are covered exactly by triangles and by convex parts") {
  std::size_t bridges = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Plate plate{outlines::star_shaped(seed), {}};
    for (glm::dvec2& p : plate.outline) p *= 8.0 / glm::length(p) + 3.0;  // radii from 8.3 to 11.3
    if (area_of(plate) < 160.0) continue;                                 // a wide gap between two corners comes near the holes
    for (int i = 0; i < 9; ++i) {
      if (random.below(3) == 0) { continue; }
      Points hole = outlines::star_shaped(1000 * seed + static_cast<std::uint32_t>(i));
      for (glm::dvec2& p : hole) { p += glm::dvec2{2.5 * (i % 3 - 1), 2.5 * (i / 3 - 1)}; }
      plate.holes.push_back(hole);
    }
    Mesh m = shells_of(plate);
    bool all_bridged = true;
    for (std::size_t i = 0; i < plate.holes.size() && all_bridged; ++i) {
      const auto ends = free_bridge(m, i, random);
      all_bridged = ends.has_value();
      if (ends) { REQUIRE(bridge(m, ends->first, ends->second)); }
    }
    if (!all_bridged) { continue; }
    bridges += plate.holes.size();
    check_whole(m, area_of(plate));
  }
  CHECK(bridges > 200);
}

TEST_CASE("coinciding corners are no excuse: crossing passes, two polygons in one point, edges that overlap are refused") {
  // A bow tie whose crossing is a corner of both strokes.
  CHECK(refused({{0, 0}, {1, 1}, {3, 3}, {3, -1}, {1, 1}, {0, 2}}) == Code::not_simple);
  // Two squares in one point, and one square run through twice.
  CHECK(refused({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}) == Code::not_simple);
  CHECK(refused({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}}) == Code::not_simple);
  // A hole that runs the wrong way round, and one that leaves the outline.
  CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}}) == Code::not_simple);
  CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 5}, {3, 1}, {1, 1}}) == Code::not_simple);
  // A bridge that runs through the hole to its far corner, and one whose sides end at different places.
  CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {3, 3}}) == Code::not_simple);
  CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {2, 2}, {2, 3}, {3, 3}, {3, 1}, {1, 1}}) == Code::not_simple);
  // A hole that touches the outline in a corner, without a bridge, is one: the parts exist.
  check_whole(shapes::build(shapes::pillow_builder({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 3}, {2, 2}, {3, 1}})), 12.0);
}

TEST_CASE("of random polygons on a small grid, those that are accepted wind once around what they cover, and all can be triangulated") {
  std::size_t accepted = 0, with_holes = 0;
  shapes::Random random(7);
  for (int i = 0; i < 600000; ++i) {
    Points p;
    std::vector<glm::dvec3> in_space;
    if (random.below(2) == 0) {  // a square and a loop on a bridge
      p = rectangle({0, 0}, {4, 4});
      std::rotate(p.begin(), p.begin() + random.below(4), p.end());
      p.push_back(p[0]);
    }
    const std::size_t first = p.size();
    for (unsigned corners = 3 + random.below(first > 0 ? 3 : 7); corners > 0; --corners) {
      p.push_back({random.below(5), random.below(5)});
    }
    if (first > 0) { p.push_back(p[first]); }
    const std::size_t n = p.size();
    for (const glm::dvec2& x : p) { in_space.push_back({x, 0.0}); }
    if (!(vector_area(in_space).z > 0.0) || Outline(in_space).self_contact()) { continue; }
    ++accepted;
    std::size_t equal = 0;
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t l = 0; l < k; ++l) { equal += p[k] == p[l] ? 1 : 0; }
    }
    with_holes += equal > 0 ? 1 : 0;
    CAPTURE(i, n);
    // The winding number counts the edges that cross a ray to the right; points off all lines through grid points.
    for (int s = 0; s < 50; ++s) {
      const glm::dvec2 at{4.0 * random.unit(), 4.0 * random.unit()};
      int winding = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec2 a = p[k], b = p[(k + 1) % n];
        const double left = (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
        if (a.y <= at.y && b.y > at.y && left > 0.0) { ++winding; }
        if (a.y > at.y && b.y <= at.y && left < 0.0) { --winding; }
      }
      REQUIRE((winding == 0 || winding == 1));
    }
    if (equal > 0) { check_whole(shapes::build(shapes::pillow_builder(p)), vector_area(in_space).z); }
  }
  CAPTURE(accepted, with_holes);
  CHECK(accepted > 1000);
  CHECK(with_holes > 1000);
}
