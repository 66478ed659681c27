// SPDX-License-Identifier: MIT
// Recursive face splits: non-convex polygons fall into convex parts, impossible ones are refused.

#include <brep/split.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>

#include <brep/euler_log.hpp>
#include <brep/refine.hpp>

#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;

namespace {

using Points = std::vector<glm::dvec2>;

Points comb(unsigned teeth) {
  Points p{{0, 0}, {2.0 * teeth - 1.0, 0}};
  for (unsigned i = teeth; i-- > 0;) {
    const double x = 2.0 * i;
    p.insert(p.end(), {{x + 1.0, 3.0}, {x, 3.0}});
    if (i > 0) p.insert(p.end(), {{x, 1.0}, {x - 1.0, 1.0}});
  }
  return p;
}
Points star(unsigned points, double inner) {
  Points p;
  for (unsigned i = 0; i < 2 * points; ++i) {
    const double r = i % 2 == 0 ? 1.0 : inner, angle = shapes::pi * i / points;
    p.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return p;
}
Points spiral(unsigned turns) {
  const unsigned n = 12 * turns;
  Points p;
  for (unsigned i = 0; i <= n; ++i) {  // outward along the outer wall, back along the inner one
    const double a = 2.0 * shapes::pi * i / 12, r = 1.0 + 0.5 * i;
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  for (unsigned i = n + 1; i-- > 0;) {
    const double a = 2.0 * shapes::pi * i / 12, r = 1.0 + 0.5 * i - 2.0 * std::min(1.0, 0.2 + 0.05 * i);
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return p;
}

std::size_t check_split(const Points& outline) {
  Mesh m = shapes::build(shapes::pillow_builder(outline));
  const double whole = area(m, FaceId{0});
  const glm::dvec3 n = normal(m, FaceId{0});
  REQUIRE(whole > 0.0);
  m.data(FaceId{0}).mark(3);
  const auto parts = split_until_convex(m, FaceId{0});
  if (!parts) UNSCOPED_INFO(parts.refusal().sentence());
  REQUIRE(parts);
  CHECK((*parts)[0] == FaceId{0});
  CHECK(m.face_count() == parts->size() + 1);
  CHECK(m.vertex_count() == outline.size());
  CHECK(faults(m) == "");
  double sum = 0.0;
  for (FaceId f : *parts) {
    CHECK(is_convex(m, f));
    CHECK(glm::dot(normal(m, f), n) > 0.999);
    CHECK(m.data(f).marked(3));
    sum += area(m, f);
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));
  return parts->size();
}

Code refused(const std::vector<glm::dvec3>& points) {
  Builder b;
  std::vector<std::uint32_t> front, back;
  for (const auto& p : points) {
    front.push_back(b.vertex(p));
    back.insert(back.begin(), front.back());
  }
  b.face(front, 0);
  b.face(back, 0);
  Mesh m = shapes::build(b);
  const auto before = shapes::records(m);
  const auto parts = split_until_convex(m, FaceId{0});
  CHECK(shapes::records(m) == before);
  CHECK_FALSE(parts.refusal().sentence().empty());
  return parts.refusal().code;
}

}  // namespace

TEST_CASE("L, U, comb, star and spiral fall into convex parts that cover them") {
  CHECK(check_split({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) == 2);
  CHECK(check_split({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) <= 4);
  for (unsigned teeth : {2u, 3u, 10u, 40u}) CHECK(check_split(comb(teeth)) <= 2 * teeth);
  for (unsigned points : {3u, 4u, 5u, 17u, 60u}) {
    for (double inner : {0.1, 0.3, 0.45}) check_split(star(points, inner));
  }
  for (unsigned turns : {1u, 2u, 6u}) check_split(spiral(turns));
}

TEST_CASE("a convex face, straight corners or not, stays whole") {
  CHECK(check_split({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}) == 1);
  CHECK(check_split({{0, 0}, {1, 0}, {0, 1}}) == 1);
}

TEST_CASE("an L with T-vertices on its edges") {
  check_split({{0, 0}, {0.5, 0}, {1, 0}, {2, 0}, {2, 0.5}, {2, 1}, {1.5, 1}, {1, 1}, {1, 1.5}, {1, 2}, {0, 2}, {0, 1}});
}

TEST_CASE("random star-shaped polygons at any scale fall into convex parts") {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const unsigned n = 5 + random.below(60);
    const double scale = std::pow(10.0, 12.0 * random.unit() - 6.0);
    Points p;
    for (unsigned i = 0; i < n; ++i) {
      const double a = 2.0 * shapes::pi * (i + 0.8 * random.unit()) / n, r = scale * (0.1 + random.unit());
      p.push_back({r * std::cos(a), r * std::sin(a)});
    }
    check_split(p);
  }
}

TEST_CASE("self-crossing, touching, bent and degenerate polygons are refused and nothing changes") {
  CHECK(refused({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}) == Code::not_simple);              // a bow tie
  CHECK(refused({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}) == Code::not_simple);   // a corner touches an edge
  CHECK(refused({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, -1, 0}, {0, 4, 0}}) == Code::not_simple);  // it goes through
  CHECK(refused({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 4, 0}, {3, 5, 0}, {3, 4, 0}, {0, 4, 0}}) == Code::not_simple);  // a spike
  CHECK(refused({{0, 0, 0}, {2, 0, 0}, {2, 1, 1}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}) == Code::not_planar);
  CHECK(refused({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1.5, 0, 0}}) == Code::degenerate_polygon);
  Mesh m;
  REQUIRE(make_segment(m));
  CHECK(split_until_convex(m, FaceId{0}).refusal().code == Code::few_corners);
  CHECK(split_until_convex(m, FaceId{7}).refusal().code == Code::dead);
}

TEST_CASE("split and condition objects combine: at most four edges by nice splits, and rejoin takes all back") {
  Mesh m = shapes::build(shapes::prism_builder(40));
  const auto before = shapes::records(m);
  const auto parts = split_recursively(m, FaceId{1}, NiceSplit{}, quadrangles);
  REQUIRE(parts);
  CHECK(parts->unfinished.empty());
  CHECK(parts->steps.size() + 1 == parts->faces.size());
  for (FaceId f : parts->faces) CHECK((degree(m, f) <= 4 && is_convex(m, f)));
  CHECK(faults(m) == "");
  rejoin(m, *parts);
  CHECK(shapes::records(m) == before);
}

namespace {

// Staircases on all sides: only right angles, about half of the corners non-convex.
Points rectilinear(std::uint32_t seed) {
  shapes::Random random(seed);
  Points p;
  const unsigned n = 2 + random.below(12);
  double x = 0.0;
  for (unsigned i = 0; i < n; ++i) {  // below, from left to right
    const double y = -0.5 - random.unit();
    p.push_back({x, y});
    x += 0.1 + random.unit();
    p.push_back({x, y});
  }
  for (unsigned i = 0; i < n; ++i) {  // above, from right to left; the strip between is free
    const double y = 0.5 + random.unit();
    p.push_back({x, y});
    x = i + 1 < n ? x * (0.4 + 0.5 * random.unit()) : 0.0;
    p.push_back({x, y});
  }
  return p;
}

// The parts cover the face: their areas, all positive along its normal, add up to the face's.
void check_cover(const Mesh& m, const Parts& parts, double whole, const glm::dvec3& n) {
  double sum = 0.0;
  for (FaceId f : parts.faces) {
    CHECK(glm::dot(vector_area(m, f), n) > 0.0);
    sum += area(m, f);
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));
}

// What is asked of every successful split: valid, covering, the data of the parent, and the condition, but for the unfinished parts.
template <class Split, class Condition>
std::size_t check_parts(const Points& outline, const Split& split, const Condition& condition, bool all_finished) {
  Mesh m = shapes::build(shapes::pillow_builder(outline));
  const double whole = area(m, FaceId{0});
  const glm::dvec3 n = normal(m, FaceId{0});
  m.data(FaceId{0}).mark(6);
  const auto before = shapes::records(m);
  const auto parts = split_recursively(m, FaceId{0}, split, condition);
  REQUIRE(parts);
  CHECK(faults(m) == "");
  check_cover(m, *parts, whole, n);
  std::size_t missed = 0;
  for (FaceId f : parts->faces) {
    CHECK(m.data(f).marked(6));
    if (!condition(m, f)) ++missed;
  }
  CHECK(missed == parts->unfinished.size());
  if (all_finished) CHECK(missed == 0);
  for (FaceId f : parts->unfinished) CHECK(!split(m, f).a.valid());
  rejoin(m, *parts);
  CHECK(shapes::records(m) == before);
  return parts->faces.size();
}

Points star_shaped(std::uint32_t seed) {
  shapes::Random random(seed);
  const unsigned n = 4 + random.below(40);
  Points p;
  for (unsigned i = 0; i < n; ++i) {
    const double a = 2.0 * shapes::pi * (i + 0.8 * random.unit()) / n, r = 0.1 + random.unit();
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return p;
}

Refusal refusal_of(const auto& split, std::size_t limit = 65536) {
  Mesh m = shapes::build(shapes::prism_builder(6));
  REQUIRE(split_face(m, m.halfedge(FaceId{1}), m.next(m.next(m.halfedge(FaceId{1})))));  // something that must be left alone
  const auto before = shapes::records(m);
  const auto parts = split_recursively(
      m, FaceId{0}, split, [](const Mesh&, FaceId) { return false; }, limit);
  REQUIRE_FALSE(parts.has_value());
  CHECK(shapes::records(m) == before);
  CHECK_FALSE(parts.refusal().sentence().empty());
  return parts.refusal();
}

}  // namespace

TEST_CASE("every condition object with every split object on stars, spirals and staircases: covered, inherited, met or reported") {
  for (std::uint32_t seed = 1; seed <= 25; ++seed) {
    INFO("seed " << seed);
    for (const Points& p : {star_shaped(seed), rectilinear(seed), spiral(1 + seed % 3)}) {
      const std::size_t n = p.size();
      CHECK(check_parts(p, NiceSplit{}, triangles, true) == n - 2);
      check_parts(p, NiceSplit{}, quadrangles && Convex{}, true);
      check_parts(p, first_of(AtNonConvexCorner{}, NiceSplit{}), StrictlyConvex{} && quadrangles, false);
      check_parts(p, AtNonConvexCorner{}, Convex{}, true);
      check_parts(p, NiceSplit{}, ProportionAbove{0.3}, false);
      check_parts(p, NiceSplit{}, AreaBelow{0.05}, false);
      check_parts(p, NiceSplit{}, triangles || AreaBelow{0.1} || !negate(ProportionAbove{0.6}), true);
      check_parts(p, AlongPlane{{0.1, 0.2, 0.0}, {1.0, 0.3, 0.0}}, BesidePlane{{0.1, 0.2, 0.0}, {1.0, 0.3, 0.0}}, true);
      check_parts(p, AlongPlane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, BesidePlane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, true);
    }
  }
}

TEST_CASE("conditions follow the laws of logic; operands are asked from the left, and lambdas are equal citizens") {
  const Mesh m = shapes::build(shapes::prism_builder(5));
  int asked = 0;
  const auto yes = [&](const Mesh&, FaceId) { return ++asked, true; };
  const auto no = [](const Mesh&, FaceId) { return false; };
  for (FaceId f : faces(m)) {
    CHECK((quadrangles(m, f) == (degree(m, f) == 4) && !triangles(m, f)));
    CHECK((!(quadrangles && no))(m, f) == (!quadrangles || !all_of(no))(m, f));
    CHECK((triangles && yes)(m, f) == false);
    CHECK((Convex{} || yes)(m, f));
  }
  CHECK(asked == 0);  // the left operand was enough
  const FaceId top{1};
  CHECK((Convex{} && yes)(m, top));
  CHECK(all_of(yes, negate(no), any_of(no, yes))(m, top));
  CHECK_FALSE(any_of(no, negate(yes))(m, top));
  CHECK(asked == 4);
}

TEST_CASE("a plane through a cube cuts four faces; T-vertices of the neighbours are shared; parts lie on one side") {
  Mesh m = shapes::build(shapes::cube_builder());
  const glm::dvec3 point{0.3, 0.0, 0.0}, across{2.0, 0.5, 0.0};
  const auto parts = split_recursively(m, AlongPlane{point, across}, BesidePlane{point, across});
  REQUIRE(parts);
  CHECK((m.vertex_count() == 12 && m.edge_count() == 20 && m.face_count() == 10));
  CHECK(faults(m) == "");
  CHECK(shapes::total_area(m) == test::Approx(6.0).epsilon(1e-14));
  for (FaceId f : faces(m)) {
    double lo = 0.0, hi = 0.0;
    for (const glm::dvec3& p : positions(m, f)) {
      lo = std::min(lo, glm::dot(p - point, across));
      hi = std::max(hi, glm::dot(p - point, across));
    }
    CHECK((lo > -1e-14 || hi < 1e-14));
    CHECK(is_convex(m, f));
  }
  // Through four corners: no new vertex.
  Mesh diagonal = shapes::build(shapes::cube_builder());
  REQUIRE(split_recursively(diagonal, AlongPlane{{0, 0, 0}, {1, -1, 0}}, BesidePlane{{0, 0, 0}, {1, -1, 0}}));
  CHECK((diagonal.vertex_count() == 8 && diagonal.face_count() == 8));
  // Beside the cube, along a face, and without a normal: nothing.
  for (const glm::dvec3& n : {glm::dvec3{0, 0, 1}, glm::dvec3{0.0}, glm::dvec3{NAN, 0, 0}}) {
    Mesh same = shapes::build(shapes::cube_builder());
    REQUIRE(split_recursively(same, AlongPlane{{0, 0, 1}, n}, BesidePlane{{0, 0, 1}, n}));
    CHECK(same.face_count() == 6);
  }
}

TEST_CASE("a plane cuts a face with a hole, reached by a bridge edge, beside, through and along the bridge") {
  // A square of side 4 with a square hole of side 2, bridged from (0, 0) to (1, 1), or straight along y = 2 with corners on the line.
  for (const bool straight : {false, true}) {
    Points p;
    if (straight)
      p = {{0, 2}, {0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}, {1, 2}, {1, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 2}};
    else
      p = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    for (const glm::dvec3& n :
         {glm::dvec3{0, 1, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{1, 1, 0}, glm::dvec3{1, -1, 0}, glm::dvec3{-2, 1, 0}}) {
      for (const glm::dvec3& point : {glm::dvec3{2, 2, 0}, glm::dvec3{0.5, 0.5, 0}, glm::dvec3{0.5, 2, 0}}) {
        CAPTURE(straight, n.x, n.y, point.x, point.y);
        Mesh m;  // one shell: the loop and its back, with coinciding corners as separate vertices
        m = shapes::build(shapes::pillow_builder(p));
        const double whole = area(m, FaceId{0});
        CHECK(whole == test::Approx(12.0));
        const auto parts = split_recursively(m, FaceId{0}, AlongPlane{point, n}, BesidePlane{point, n});
        REQUIRE(parts);
        CHECK(parts->faces.size() >= 2);
        CHECK(faults(m) == "");
        check_cover(m, *parts, 12.0, glm::dvec3{0, 0, 1});
        for (FaceId f : parts->faces) {
          double lo = 0.0, hi = 0.0;
          for (const glm::dvec3& x : positions(m, f)) {
            lo = std::min(lo, glm::dot(x - point, n));
            hi = std::max(hi, glm::dot(x - point, n));
          }
          CHECK((lo > -1e-12 || hi < 1e-12));
        }
      }
    }
  }
}

TEST_CASE("a lambda that halves a face by planes reaches any area; the neighbours stay closed") {
  const auto halve = [](const Mesh& m, FaceId f) {
    const auto p = positions(m, f);
    glm::dvec3 along{0.0};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec3 side = p[(i + 1) % p.size()] - p[i];
      if (glm::length(side) > glm::length(along)) along = side;
    }
    return AlongPlane{centroid(m, f), along}(m, f);
  };
  Mesh m = shapes::build(shapes::cube_builder());
  const auto parts = split_recursively(m, halve, AreaBelow{0.02});
  REQUIRE(parts);
  CHECK(parts->unfinished.empty());
  CHECK(m.face_count() >= 300);
  CHECK(faults(m) == "");
  CHECK(shapes::total_area(m) == test::Approx(6.0).epsilon(1e-12));
  for (FaceId f : faces(m)) CHECK(area(m, f) < 0.02);
}

TEST_CASE("a part that was finished is looked at again when a cut beside it puts a vertex on its edge") {
  Mesh m = shapes::build(shapes::prism_builder(4));
  const HalfedgeId first = m.halfedge(FaceId{1});
  REQUIRE(split_face(m, first, m.next(m.next(first))));  // two triangles
  const FaceId left = FaceId{1}, right = m.face(first) == left ? m.face(twin(m.prev(first))) : m.face(first);
  const std::vector<FaceId> both{left, right};
  bool cut_once = false;
  const auto split = [&](const Mesh& b, FaceId f) {
    if (degree(b, f) > 3) return NiceSplit{}(b, f);
    for (HalfedgeId h : halfedges_of(b, f)) {
      if (b.face(twin(h)) == left) return Cut{h, b.prev(h), 0.5, 0.0};
    }
    return Cut{};
  };
  const auto finished = [&](const Mesh& b, FaceId f) {
    if (f == right && !cut_once) return cut_once = true, false;
    return degree(b, f) == 3;
  };
  const auto parts = split_recursively(m, std::span<const FaceId>(both), split, finished);
  REQUIRE(parts);
  CHECK(parts->faces.size() == 4);
  for (FaceId f : parts->faces) CHECK(degree(m, f) == 3);
}

TEST_CASE("split objects that make no progress are refused, whatever they answer, and nothing changes") {
  const auto at = [](std::size_t i, std::size_t j, double s = 0.0, double t = 0.0) {
    return [=](const Mesh& m, FaceId f) {
      const auto loop = detail::loop_of(m, f);
      return Cut{loop[i % loop.size()], loop[j % loop.size()], s, t};
    };
  };
  CHECK(refusal_of(at(0, 0)).code == Code::no_progress);
  CHECK(refusal_of(at(0, 1)).code == Code::no_progress);
  CHECK(refusal_of(at(1, 0)).code == Code::no_progress);
  CHECK(refusal_of(at(0, 2)).code == Code::no_progress);            // right until a triangle is left, where 2 is next to 0
  CHECK(refusal_of(at(0, 0, 0.2, 0.7)).code == Code::no_progress);  // both ends on one edge
  CHECK(refusal_of(at(0, 1, 0.5, 0.0)).code == Code::no_progress);  // the second vertex of the edge is next to its middle
  CHECK(refusal_of(at(0, 0, 0.5, 0.0)).code == Code::no_progress);
  for (double bad : {-0.1, 1.0, 7.0, static_cast<double>(NAN), HUGE_VAL}) CHECK(refusal_of(at(0, 2, bad)).code == Code::not_on_edge);
  CHECK(refusal_of([](const Mesh& m, FaceId) { return Cut{m.halfedge(FaceId{2}), m.halfedge(FaceId{3})}; }).code == Code::not_on_face);
  CHECK(refusal_of([](const Mesh& m, FaceId f) { return Cut{m.halfedge(f), HalfedgeId{}}; }).code == Code::dead);
  CHECK(refusal_of([](const Mesh& m, FaceId f) { return Cut{m.halfedge(f), HalfedgeId{999999}}; }).code == Code::dead);
  // Middle to middle for ever: bounded by the limit.
  const Refusal endless = refusal_of(at(0, 2, 0.5, 0.5), 1000);
  CHECK(endless.code == Code::vertex_limit);
  CHECK(refusal_of(at(0, 2, 0.5, 0.0), 0).code == Code::vertex_limit);
  const auto random_answer = [random = std::make_shared<shapes::Random>(99)](const Mesh& m, FaceId f) {
    const auto loop = detail::loop_of(m, f);
    return Cut{loop[random->below(loop.size())], loop[random->below(loop.size())], random->below(2) * random->unit(), 0.0};
  };
  for (int i = 0; i < 50; ++i) CHECK(refusal_of(random_answer, 200).code != Code::none);
}

TEST_CASE("a refused split leaves a log as it was, and a split is undone by it") {
  BRep<shapes::Vertex, NoData, shapes::Face, EulerLog> m;
  const HalfedgeId h = *make_segment(m);
  for (int i = 0; i < 6; ++i) REQUIRE(split_edge(m, h));
  const auto before = shapes::records(m);
  const std::size_t place = mark(m);
  int cuts = 0;
  const auto split = [&](const auto& b, FaceId f) {
    const auto loop = detail::loop_of(b, f);
    return ++cuts < 4 ? Cut{loop[0], loop[loop.size() / 2], 0.0, 0.25} : Cut{loop[0], loop[0]};
  };
  CHECK(split_recursively(m, m.face(h), split, triangles).refusal().code == Code::no_progress);
  CHECK((shapes::records(m) == before && mark(m) == place));
  cuts = -1000;
  const auto ear = [](const auto& b, FaceId f) { return Cut{b.halfedge(f), b.next(b.next(b.halfedge(f)))}; };
  REQUIRE(split_recursively(m, m.face(h), ear, triangles));
  REQUIRE(undo_to(m, place));
  CHECK(shapes::records(m) == before);
}

TEST_CASE("T-vertices as condition and split object: with any other condition, by levels alone") {
  Mesh m = shapes::build(shapes::cube_builder());
  REQUIRE(refine(m, FaceId{2}));
  REQUIRE(refine(m, FaceId{4}));
  const FaceId side{0};
  CHECK((degree(m, side) == 6 && !NoTVertices{}(m, side)));
  std::size_t t_vertices = 0;
  for (HalfedgeId h : halfedges_of(m, side)) t_vertices += is_t_vertex(m, h) ? 1 : 0;
  CHECK(t_vertices == 2);
  const auto parts = split_recursively(m, side, AtTVertex{}, NoTVertices{});
  REQUIRE(parts);
  CHECK((parts->unfinished.empty() && parts->faces.size() == 3));  // each T-vertex is connected to a corner, not to the other one
  for (FaceId f : parts->faces) CHECK((NoTVertices{}(m, f) && m.data(f).level == 0));
  const auto more = split_recursively(m, first_of(AtTVertex{}, NiceSplit{}), triangles && NoTVertices{});
  REQUIRE(more);
  CHECK(more->unfinished.empty());
  for (FaceId f : faces(m)) CHECK((degree(m, f) == 3 && NoTVertices{}(m, f)));
  CHECK(faults(m) == "");
}
