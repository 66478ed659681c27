// SPDX-License-Identifier: MIT
// Regular refinement by level tags, and the elimination of T-vertices.

#include <brep/refine.hpp>

#include <set>

#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;

namespace {

std::vector<FaceId> all_faces(const Mesh& m) {
  std::vector<FaceId> all;
  for (FaceId f : faces(m)) { all.push_back(f); }
  return all;
}
std::size_t count_t_vertices(const Mesh& m, FaceId f) {
  std::size_t n = 0;
  for (HalfedgeId h : halfedges_of(m, f)) { n += m.data(m.vertex(h)).level > m.data(f).level; }
  return n;
}
Mesh refined_at_random(const Builder& solid, std::uint32_t seed, int steps) {
  Mesh m = shapes::build(solid);
  shapes::Random random(seed);
  for (int i = 0; i < steps; ++i) {
    const auto all = all_faces(m);
    REQUIRE(refine(m, all[random.below(all.size())]));
  }
  return m;
}
const std::vector<Builder>& refined_solids() {
  static const std::vector<Builder> all{shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(3),
                                        shapes::prism_builder(5), shapes::prism_builder(12)};
  return all;
}

}  // namespace

TEST_CASE("a face of n corners: children, levels, counts, corner 0, centroid") {
  for (std::uint32_t n : {3u, 4u, 5u, 6u, 12u, 40u}) {
    INFO("n = " << n);
    Mesh m = shapes::build(shapes::prism_builder(n));
    const FaceId top{1};
    m.data(top).label = 5;
    const auto before = corners(m, top);
    std::vector<VertexId> old_corner;
    for (HalfedgeId h : before) { old_corner.push_back(m.vertex(h)); }
    REQUIRE(old_corner.size() == n);
    const double whole = area(m, top);
    const glm::dvec3 centre = centroid(m, top);
    const std::size_t v = m.vertex_count(), e = m.edge_count(), f = m.face_count();
    const auto children = refine(m, top);
    REQUIRE(children);
    CHECK(children->size() == (n == 3 ? 4 : n));
    CHECK((*children)[0] == top);
    CHECK(m.vertex_count() == v + n + (n > 3 ? 1 : 0));
    CHECK(m.edge_count() == e + n + (n > 3 ? n : 3));
    CHECK(m.face_count() == f + children->size() - 1);
    CHECK(faults(m) == "");
    double sum = 0.0;
    for (std::size_t k = 0; k < children->size(); ++k) {
      const FaceId child = (*children)[k];
      const auto c = corners(m, child);
      CHECK(c.size() == (n == 3 ? 3 : 4));
      CHECK(m.halfedge(child) == c[0]);
      CHECK((m.data(child).level == 1 && m.data(child).sheet == 1 && m.data(child).label == 5));
      if (k < n) { CHECK(m.vertex(c[0]) == old_corner[k]); }
      if (k < n) {  // (c_k, m_k, centre, m_{k-1})
        const auto at = [&](std::size_t i) { return m.data(m.vertex(c[i])).position; };
        const auto corner = [&](std::size_t i) { return m.data(old_corner[i % n]).position; };
        CHECK(glm::distance(at(1), 0.5 * (corner(k) + corner(k + 1))) < 1e-15);
        CHECK(glm::distance(at(c.size() - 1), 0.5 * (corner(k) + corner(k + n - 1))) < 1e-15);
        if (n > 3) { CHECK(glm::distance(at(2), centre) < 1e-15); }
      }
      CHECK(is_convex(m, child));
      sum += area(m, child);
    }
    CHECK(sum == test::Approx(whole).epsilon(1e-14));
  }
}

TEST_CASE("vertices of the neighbour's earlier split serve as anchor points (fig. 4)") {
  Mesh m = shapes::build(shapes::cube_builder());
  std::size_t v = m.vertex_count();
  REQUIRE(refine(m, FaceId{0}));
  CHECK(m.vertex_count() == v + 5);  // four mid-points and the centre
  v = m.vertex_count();
  REQUIRE(refine(m, FaceId{2}));  // shares one edge with face 0
  CHECK(m.vertex_count() == v + 4);
  CHECK(count_t_vertices(m, FaceId{1}) == 1);
  v = m.vertex_count();
  // A child next to the unrefined side is split twice more; then that side, which reuses the level 1 vertex only.
  const FaceId side{1};
  for (int i = 0; i < 2; ++i) {
    for (HalfedgeId h : halfedges_of(m, side)) {
      if (m.face(twin(h)) != side && m.data(m.face(twin(h))).level == i + 1) {
        REQUIRE(refine(m, m.face(twin(h))));
        break;
      }
    }
  }
  CHECK(count_t_vertices(m, side) >= 3);
  v = m.vertex_count();
  REQUIRE(refine(m, side));
  CHECK(m.vertex_count() == v + 4);  // three mid-points and the centre
  CHECK(faults(m) == "");
}

TEST_CASE("the level rule gives the same T-vertices as geometry on a cube's grids") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    const Mesh m = refined_at_random(shapes::cube_builder(), seed, 150);
    for (FaceId f : faces(m)) {
      const auto p = positions(m, f);
      const Outline outline(p);
      const auto loop = detail::loop_of(m, f);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const bool by_level = m.data(m.vertex(loop[i])).level > m.data(f).level;
        REQUIRE(by_level == (std::abs(outline.turn(i)) < 0.1));
      }
    }
  }
}

TEST_CASE("random refinement: always valid, v - e + f = 2(s - h), area kept, faces convex, child k begins at the parent's corner k") {
  for (const Builder& solid : refined_solids()) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      INFO("seed " << seed);
      Mesh m = shapes::build(solid);
      const double whole = shapes::total_area(m);
      shapes::Random random(seed);
      for (int step = 0; step < 60; ++step) {
        const auto all = all_faces(m);
        // Now and then the last child again, so that deep levels stand beside coarse ones.
        const FaceId f = random.below(3) == 0 ? all.back() : all[random.below(all.size())];
        std::vector<VertexId> corner;
        for (HalfedgeId h : corners(m, f)) { corner.push_back(m.vertex(h)); }
        const auto children = refine(m, f);
        REQUIRE(children);
        for (std::size_t k = 0; k < corner.size(); ++k) { REQUIRE(m.vertex(corners(m, (*children)[k])[0]) == corner[k]); }
        REQUIRE(faults(m) == "");
        REQUIRE(genus(m) == 0);
      }
      for (FaceId f : faces(m)) { REQUIRE(is_convex(m, f)); }
      CHECK(shapes::total_area(m) == test::Approx(whole).epsilon(1e-12));
    }
  }
}

TEST_CASE("corner 0 does not depend on what the neighbours do") {
  for (const Builder& solid : refined_solids()) {
    Mesh m = shapes::build(solid);
    std::vector<VertexId> first;
    for (FaceId f : faces(m)) { first.push_back(m.vertex(corners(m, f)[0])); }
    const std::size_t n = m.face_count();
    for (std::uint32_t f = 1; f < n; ++f) { REQUIRE(refine(m, FaceId{f})); }
    CHECK(m.vertex(corners(m, FaceId{0})[0]) == first[0]);
    CHECK(count_t_vertices(m, FaceId{0}) == degree(m, FaceId{0}) / 2);
  }
}

TEST_CASE("place is asked once for each new vertex, on a valid BRep, and may move it") {
  Mesh m = shapes::build(shapes::cube_builder());
  std::set<VertexId> placed;
  const auto on_sphere = [&](Mesh& brep, VertexId v) {
    CHECK(faults(brep) == "");
    CHECK(brep.data(v).level == 1);
    CHECK(placed.insert(v).second);
    glm::dvec3& p = brep.data(v).position;
    p = glm::dvec3{0.5} + std::sqrt(0.75) * glm::normalize(p - glm::dvec3{0.5});
  };
  for (std::uint32_t f = 0; f < 6; ++f) { REQUIRE(refine(m, FaceId{f}, on_sphere)); }
  CHECK(placed.size() == 12 + 6);
  for (VertexId v : vertices(m)) { CHECK(glm::distance(m.data(v).position, glm::dvec3{0.5}) == test::Approx(std::sqrt(0.75))); }
}

TEST_CASE("refine is refused, and nothing changed: level 255, few corners, levels that refine did not make") {
  Mesh m = shapes::build(shapes::cube_builder());
  m.data(FaceId{0}).level = 255;
  auto before = shapes::records(m);
  CHECK(refine(m, FaceId{0}).refusal().code == Code::level_limit);
  CHECK(refine(m, FaceId{99}).refusal().code == Code::dead);
  const HalfedgeId n = *split_edge(m, m.halfedge(FaceId{1}));
  m.data(m.vertex(n)).level = 7;
  before = shapes::records(m);
  const auto refused = refine(m, FaceId{1});
  CHECK(refused.refusal().code == Code::irregular_levels);
  CHECK(refused.refusal().sentence().find("f1") != std::string::npos);
  Mesh segment;
  REQUIRE(make_segment(segment));
  CHECK(refine(segment, FaceId{0}).refusal().code == Code::few_corners);
  for (VertexId v : vertices(segment)) { segment.data(v).level = 9; }
  CHECK(refine(segment, FaceId{0}).refusal().code == Code::few_corners);  // no corner at all
  CHECK(shapes::records(m) == before);
}

TEST_CASE("a face with a spur inside, on both sides of an edge, can be refined too") {
  for (std::uint32_t n : {3u, 4u, 6u}) {
    Mesh m = shapes::build(shapes::prism_builder(n));
    const HalfedgeId a = m.halfedge(FaceId{1});
    const HalfedgeId h = *split_vertex(m, a, a);
    m.data(m.target(h)).position = {0.0, 0.0, 1.0};
    REQUIRE(corners(m, FaceId{1}).size() == n + 2);
    const auto children = refine(m, FaceId{1});
    REQUIRE(children);
    CHECK(children->size() == n + 2);
    CHECK(faults(m) == "");
    for (FaceId child : *children) { CHECK(corners(m, child).size() == 4); }
  }
}

TEST_CASE("T-vertex elimination leaves triangles and quadrilaterals only, without T-vertices, and keeps the area") {
  for (const Builder& solid : refined_solids()) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
      INFO("seed " << seed);
      Mesh m = refined_at_random(solid, seed, 60);
      const double whole = shapes::total_area(m);
      for (FaceId f : all_faces(m)) {
        const glm::dvec3 n = normal(m, f);
        const double before = area(m, f);
        const std::uint32_t sheet = m.data(f).sheet;
        const std::size_t count = m.face_count(), end = m.face_end();
        const std::size_t added = eliminate_t_vertices(m, f);
        REQUIRE(m.face_count() == count + added);
        double sum = area(m, f);
        for (std::size_t i = end; i < m.face_end(); ++i) {
          const FaceId part{static_cast<std::uint32_t>(i)};
          sum += area(m, part);
          REQUIRE(m.data(part).sheet == sheet);
          REQUIRE(glm::dot(normal(m, part), n) > 0.999);  // same side up
        }
        REQUIRE(sum == test::Approx(before).epsilon(1e-12));
      }
      CHECK(faults(m) == "");
      CHECK(genus(m) == 0);
      for (FaceId f : faces(m)) {
        REQUIRE(degree(m, f) <= 4);
        REQUIRE(count_t_vertices(m, f) == 0);
        const Outline outline{Polygon(positions(m, f))};
        for (std::size_t i = 0; i < outline.size(); ++i) { REQUIRE(outline.turn(i) > 1e-6); }
      }
      CHECK(shapes::total_area(m) == test::Approx(whole).epsilon(1e-12));
      for (FaceId f : all_faces(m)) REQUIRE(eliminate_t_vertices(m, f) == 0);  // nothing is left to do
    }
  }
}

TEST_CASE("T-vertex elimination on a sphere, where T-vertices do not lie on the edges") {
  Mesh m = shapes::build(shapes::cube_builder());
  const auto on_sphere = [](Mesh& brep, VertexId v) {
    glm::dvec3& p = brep.data(v).position;
    p = glm::dvec3{0.5} + std::sqrt(0.75) * glm::normalize(p - glm::dvec3{0.5});
  };
  shapes::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto all = all_faces(m);
    REQUIRE(refine(m, all[random.below(all.size())], on_sphere));
  }
  for (FaceId f : all_faces(m)) {
    const glm::dvec3 n = normal(m, f);  // of the mean plane: a part may stand steep on it, but not upside down
    const std::size_t end = m.face_end();
    eliminate_t_vertices(m, f);
    REQUIRE(glm::dot(normal(m, f), n) > 0.0);
    for (std::size_t i = end; i < m.face_end(); ++i) { REQUIRE(glm::dot(normal(m, FaceId{static_cast<std::uint32_t>(i)}), n) > 0.0); }
  }
  CHECK(faults(m) == "");
  for (FaceId f : faces(m)) {
    REQUIRE(degree(m, f) <= 4);
    REQUIRE(count_t_vertices(m, f) == 0);
  }
}
