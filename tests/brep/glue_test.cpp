// SPDX-License-Identifier: MIT
// Gluing two faces and punching holes: solids, their counts, genus and volume.

#include <brep/glue.hpp>

#include <brep/extrude.hpp>
#include <brep/shells.hpp>
#include <brep/testing.hpp>

#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;

namespace {

Builder several(const std::vector<std::pair<Builder, glm::dvec3>>& solids) {
  Builder b;
  for (const auto& [part, offset] : solids) {
    const auto base = static_cast<std::uint32_t>(b.vertex_count());
    for (std::uint32_t v = 0; v < part.vertex_count(); ++v) { b.vertex(part.position(v) + offset); }
    for (std::uint32_t f = 0; f < part.face_count(); ++f) {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t v : part.corners(f)) { corners.push_back(base + v); }
      b.face(corners, 0);
    }
  }
  return b;
}

// The half-edge on g that lies opposite to a, by positions.
HalfedgeId opposite(const Mesh& m, HalfedgeId a, FaceId g) {
  for (HalfedgeId c : halfedges_of(m, g)) {
    if (m.data(m.vertex(c)).position == m.data(m.target(a)).position && m.data(m.target(c)).position == m.data(m.vertex(a)).position) {
      return c;
    }
  }
  return {};
}

}  // namespace

TEST_CASE("two cubes glued are one box of 12 vertices, 20 edges and 10 faces") {
  Mesh m = shapes::build(several({{shapes::cube_builder(), {0, 0, 0}}, {shapes::cube_builder(), {0, 0, 1}}}));
  const HalfedgeId a = m.halfedge(FaceId{1}), c = opposite(m, a, FaceId{6});
  REQUIRE(c.valid());
  const VertexId kept = m.vertex(a);
  REQUIRE(*glue_faces(m, a, c) == 4);
  CHECK((m.vertex_count() == 12 && m.edge_count() == 20 && m.face_count() == 10));
  CHECK(faults(m) == "");
  CHECK((shell_count(m) == 1 && genus(m) == 0));
  CHECK((m.alive(a) && m.vertex(a) == kept && !m.alive(c) && !m.alive(FaceId{1}) && !m.alive(FaceId{6})));
  for (FaceId f : faces(m)) { CHECK((degree(m, f) == 4 && area(m, f) == 1.0)); }
}

TEST_CASE("gluing two faces of one shell makes a handle: a ring of eight cubes has genus 1") {
  std::vector<std::pair<Builder, glm::dvec3>> cubes;
  const std::vector<glm::dvec3> ring{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  for (const glm::dvec3& p : ring) { cubes.push_back({shapes::cube_builder(), p}); }
  Mesh m = shapes::build(several(cubes));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    bool found = false;
    const auto in_cube = [&](FaceId f, std::size_t k) { return f.index / 6 == k; };
    for (FaceId f : faces(m)) {
      for (FaceId g : faces(m)) {
        if (found || !in_cube(f, i) || !in_cube(g, (i + 1) % ring.size())) { continue; }
        const HalfedgeId a = m.halfedge(f), c = opposite(m, a, g);
        if (!c.valid() || centroid(m, f) != centroid(m, g)) { continue; }
        REQUIRE(glue_faces(m, a, c));
        REQUIRE(faults(m) == "");
        found = true;
      }
    }
    REQUIRE(found);
  }
  CHECK((shell_count(m) == 1 && genus(m) == 1));
  // 16 outer and inner faces on the sides, 16 above and below; the vertices are those of a 3 x 3 grid of columns without inner ones: 4 x 4
  // x 2.
  CHECK((m.face_count() == 32 && m.vertex_count() == 32 && m.edge_count() == 64));
}

TEST_CASE("gluing is undone by cutting the seam: double its edges, split its vertices, join the belt, cut the last post") {
  Mesh m = shapes::build(several({{shapes::prism_builder(5), {0, 0, 0}}, {shapes::prism_builder(5), {0, 0, 1}}}));
  const Mesh two = m;
  const HalfedgeId a = m.halfedge(FaceId{1}), c = opposite(m, a, FaceId{7});
  REQUIRE(c.valid());
  REQUIRE(*glue_faces(m, a, c) == 5);
  CHECK(shell_count(m) == 1);
  std::vector<HalfedgeId> seam, doubles;
  for (HalfedgeId h = a; seam.empty() || h != a; h = m.next(twin(m.next(h)))) seam.push_back(h);  // straight on, the degree is four
  REQUIRE(seam.size() == 5);
  for (HalfedgeId h : seam) { doubles.push_back(*split_face(m, h, m.next(h))); }
  std::vector<HalfedgeId> posts;
  for (std::size_t i = 0; i < 5; ++i) { posts.push_back(*split_vertex(m, seam[i], twin(doubles[(i + 4) % 5]))); }
  for (std::size_t i = 1; i < 5; ++i) { REQUIRE(join_faces(m, posts[i])); }
  REQUIRE(cut(m, posts[0]));
  CHECK(faults(m) == "");
  CHECK_THAT(m, IsIsomorphicTo(two));
}

TEST_CASE("a hole punched through a cube: genus 1, through a cube with inset caps it has the right volume, and it is undone") {
  Mesh m = shapes::build(shapes::cube_builder());
  const auto inward = [](Mesh& b, VertexId lifted, VertexId base) {
    const glm::dvec3 p = b.data(base).position, axis{0.5, 0.5, p.z};
    b.data(lifted).position = axis + 0.5 * (p - axis);
  };
  REQUIRE(extrude_face(m, FaceId{0}, inward));
  REQUIRE(extrude_face(m, FaceId{1}, inward));
  const auto before = records(m);
  const HalfedgeId a = m.halfedge(FaceId{0});
  HalfedgeId c{};
  for (HalfedgeId x : halfedges_of(m, FaceId{1})) {
    const glm::dvec3 p = m.data(m.target(x)).position, q = m.data(m.vertex(a)).position;
    if (p.x == q.x && p.y == q.y) { c = x; }
  }
  REQUIRE(c.valid());
  const std::size_t v = m.vertex_count(), e = m.edge_count(), f = m.face_count();
  const HalfedgeId h = *punch_hole(m, a, c);
  CHECK((m.vertex(h) == m.vertex(a) && m.target(h) == m.target(c) && m.face(twin(h)) == m.face(a) && m.face(a) == m.face(c)));
  CHECK((m.vertex_count() == v && m.edge_count() == e + 4 && m.face_count() == f + 2));
  REQUIRE(faults(m) == "");
  CHECK(genus(m) == 1);
  double volume = 0.0;
  for (FaceId g : faces(m)) {
    REQUIRE(degree(m, g) == 4);
    volume += glm::dot(vector_area(m, g), positions(m, g)[0]) / 3.0;
  }
  CHECK(volume == test::Approx(0.75).epsilon(1e-14));
  // Undone: the rungs, last made first, then the bridge.
  std::vector<HalfedgeId> rungs;
  for (HalfedgeId x = h; rungs.size() < 4;) {
    rungs.push_back(x);
    x = m.next(m.next(twin(x)));
  }
  for (std::size_t i = 3; i > 0; --i) { REQUIRE(join_faces(m, m.next(m.next(twin(rungs[i - 1]))))); }
  REQUIRE(cut(m, h));
  CHECK(genus(m) == 0);
  CHECK((m.vertex_count() == v && m.edge_count() == e && m.face_count() == f));
  CHECK(faults(m) == "");
}

TEST_CASE("punch_hole between two shells makes one, between faces that share a vertex or an edge it is legal") {
  Mesh m = shapes::build(several({{shapes::cube_builder(), {0, 0, 0}}, {shapes::cube_builder(), {0, 0, 5}}}));
  Mesh copy = m;
  REQUIRE(punch_hole(m, m.halfedge(FaceId{1}), m.halfedge(FaceId{6})));
  CHECK((shell_count(m) == 1 && genus(m) == 0 && m.face_count() == 14));
  CHECK(faults(m) == "");
  const HalfedgeId a = copy.halfedge(FaceId{0});
  REQUIRE(punch_hole(copy, a, twin(a)));
  CHECK((shell_count(copy) == 2 && genus(copy) == 1));
  CHECK(faults(copy) == "");
}
