// SPDX-License-Identifier: MIT
// Recursive face splits: every split object with every condition object, and what is refused.

#include <brep/split.hpp>

#include <limits>
#include <memory>
#include <span>

#include <brep/euler_log.hpp>
#include <brep/refine.hpp>

#include "outlines.hpp"
#include "shapes.hpp"

using namespace brep;
using outlines::check_cover;
using outlines::Points;
using shapes::faults;
using shapes::Mesh;

namespace {

// What is asked of every successful split: valid, covering, the data of the parent, and the condition, but for the unfinished parts.
template <class Split, class Condition>
std::size_t check_parts(const Points& outline, const Split& split, const Condition& condition, bool all_finished) {
  Mesh m = shapes::build(shapes::pillow_builder(outline));
  const double whole = area(m, FaceId{0});
  const glm::dvec3 n = normal(m, FaceId{0});
  m.data(FaceId{0}).label = 6;
  const auto before = shapes::records(m);
  const auto parts = split_recursively(m, FaceId{0}, split, condition);
  REQUIRE(parts);
  CHECK(faults(m) == "");
  check_cover(m, parts->faces, whole, n);
  std::size_t missed = 0;
  for (FaceId f : parts->faces) {
    CHECK(m.data(f).label == 6);
    if (!condition(m, f)) { ++missed; }
  }
  CHECK(missed == parts->unfinished.size());
  if (all_finished) { CHECK(missed == 0); }
  for (FaceId f : parts->unfinished) { CHECK(!split(m, f).a.valid()); }
  rejoin(m, *parts);
  CHECK(shapes::records(m) == before);
  return parts->faces.size();
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

TEST_CASE("split and condition objects combine: at most four edges by nice splits, and rejoin takes all back") {
  Mesh m = shapes::build(shapes::prism_builder(40));
  const auto before = shapes::records(m);
  const auto parts = split_recursively(m, FaceId{1}, NiceSplit{}, quadrangles);
  REQUIRE(parts);
  CHECK(parts->unfinished.empty());
  CHECK(parts->steps.size() + 1 == parts->faces.size());
  for (FaceId f : parts->faces) { CHECK((degree(m, f) <= 4 && is_convex(m, f))); }
  CHECK(faults(m) == "");
  rejoin(m, *parts);
  CHECK(shapes::records(m) == before);
}

TEST_CASE("conditions and split objects: every pair on stars, spirals and staircases covers, inherits, meets or reports") {
  for (std::uint32_t seed = 1; seed <= 25; ++seed) {
    INFO("seed " << seed);
    for (const Points& p : {outlines::star_shaped(seed), outlines::rectilinear(seed), outlines::spiral(1 + seed % 3)}) {
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

TEST_CASE("conditions follow the laws of logic, operands are asked from the left, and lambdas are equal citizens") {
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

TEST_CASE("a lambda that halves a face by planes reaches any area, the neighbours stay closed") {
  const auto halve = [](const Mesh& m, FaceId f) {
    const auto p = positions(m, f);
    glm::dvec3 along{0.0};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec3 side = p[(i + 1) % p.size()] - p[i];
      if (glm::length(side) > glm::length(along)) { along = side; }
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
  for (FaceId f : faces(m)) { CHECK(area(m, f) < 0.02); }
}

TEST_CASE("a part that was finished is looked at again when a cut beside it puts a vertex on its edge") {
  Mesh m = shapes::build(shapes::prism_builder(4));
  const HalfedgeId first = m.halfedge(FaceId{1});
  REQUIRE(split_face(m, first, m.next(m.next(first))));  // two triangles
  const FaceId left = FaceId{1}, right = m.face(first) == left ? m.face(twin(m.prev(first))) : m.face(first);
  const std::vector<FaceId> both{left, right};
  bool cut_once = false;
  const auto split = [&](const Mesh& b, FaceId f) {
    if (degree(b, f) > 3) { return NiceSplit{}(b, f); }
    for (HalfedgeId h : halfedges_of(b, f)) {
      if (b.face(twin(h)) == left) { return Cut{h, b.prev(h), 0.5, 0.0}; }
    }
    return Cut{};
  };
  const auto finished = [&](const Mesh& b, FaceId f) {
    if (f == right && !cut_once) { return cut_once = true, false; }
    return degree(b, f) == 3;
  };
  const auto parts = split_recursively(m, std::span<const FaceId>(both), split, finished);
  REQUIRE(parts);
  CHECK(parts->faces.size() == 4);
  for (FaceId f : parts->faces) { CHECK(degree(m, f) == 3); }
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
  for (double bad : {-0.1, 1.0, 7.0, static_cast<double>(NAN), HUGE_VAL}) { CHECK(refusal_of(at(0, 2, bad)).code == Code::not_on_edge); }
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
  for (int i = 0; i < 50; ++i) { CHECK(refusal_of(random_answer, 200).code != Code::none); }
}

TEST_CASE("a refused split leaves a log as it was, and a split is undone by it") {
  BRep<shapes::Vertex, NoData, shapes::Face, EulerLog> m;
  const HalfedgeId h = *make_segment(m);
  for (int i = 0; i < 6; ++i) { REQUIRE(split_edge(m, h)); }
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
  for (HalfedgeId h : halfedges_of(m, side)) { t_vertices += is_t_vertex(m, h) ? 1 : 0; }
  CHECK(t_vertices == 2);
  const auto parts = split_recursively(m, side, AtTVertex{}, NoTVertices{});
  REQUIRE(parts);
  CHECK((parts->unfinished.empty() && parts->faces.size() == 3));  // each T-vertex is connected to a corner, not to the other one
  for (FaceId f : parts->faces) { CHECK((NoTVertices{}(m, f) && m.data(f).level == 0)); }
  const auto more = split_recursively(m, first_of(AtTVertex{}, NiceSplit{}), triangles && NoTVertices{});
  REQUIRE(more);
  CHECK(more->unfinished.empty());
  for (FaceId f : faces(m)) { CHECK((degree(m, f) == 3 && NoTVertices{}(m, f))); }
  CHECK(faults(m) == "");
}
