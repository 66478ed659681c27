// SPDX-License-Identifier: MIT
// Collapse and flip: counts, inverses, refusals, and random maps with every degenerate state.

#include <brep/edit.hpp>

#include <map>
#include <set>

#include <brep/euler_log.hpp>
#include <brep/extrude.hpp>
#include <brep/neighbours.hpp>
#include <brep/testing.hpp>
#include <brep/triangulate.hpp>

#include "calls.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;
using shapes::Random;
using shapes::records;

namespace {

using Bare = BRep<>;

// Edges that are loops, or join the same vertices as an edge before.
template <class B>
std::size_t not_simple(const B& m) {
  std::set<std::pair<VertexId, VertexId>> seen;
  std::size_t n = 0;
  for (EdgeId e : edges(m)) {
    const auto [v, w] = vertices_of(m, e);
    if (v == w || !seen.insert(std::minmax(v, w)).second) { ++n; }
  }
  return n;
}

}  // namespace

TEST_CASE("collapse_edge between triangles: v-1 e-3 f-2, and splitting the vertex again restores the map") {
  Mesh m = shapes::build(shapes::torus_builder(5, 6));
  REQUIRE(triangulate(m));
  for (HalfedgeId h : shapes::all_halfedges(m)) {
    Mesh copy = m;
    // To turn the collapse round: the half-edges that are merged with those of the killed edges, seen from v.
    const HalfedgeId left = copy.prev(h), right = copy.next(twin(h));
    const VertexId v = copy.vertex(h), w = copy.target(h);
    const glm::dvec3 place = copy.data(v).position;
    REQUIRE(*collapse_edge(copy, h) == v);
    CHECK((!copy.alive(w) && !copy.alive(h) && copy.alive(left) && copy.alive(right)));
    CHECK(copy.data(v).position == place);
    CHECK((copy.vertex_count() + 1 == m.vertex_count() && copy.edge_count() + 3 == m.edge_count() &&
           copy.face_count() + 2 == m.face_count()));
    REQUIRE(faults(copy) == "");
    CHECK((genus(copy) == 1 && not_simple(copy) == 0));
    // Double v - x and v - y; then split v in the corners between the doubles.
    const HalfedgeId p = *split_face(copy, copy.next(left), left), q = *split_face(copy, right, copy.next(right));
    REQUIRE((degree(copy, copy.face(left)) == 2 && degree(copy, copy.face(right)) == 2));
    REQUIRE((copy.face(p) != copy.face(left) || copy.face(twin(p)) != copy.face(left)));
    const HalfedgeId a = copy.next(left), b = right;
    REQUIRE((copy.vertex(a) == v && copy.vertex(b) == v && edge(a) == edge(p) && edge(copy.next(right)) == edge(q)));
    REQUIRE(split_vertex(copy, a, b));
    REQUIRE(faults(copy) == "");
    CHECK_THAT(copy, IsIsomorphicTo(m));
  }
}

TEST_CASE("collapse_edge between quadrilaterals: v-1 e-1, the faces become triangles") {
  Mesh m = shapes::build(shapes::cube_builder());
  REQUIRE(collapse_edge(m, HalfedgeId{0}));
  CHECK((m.vertex_count() == 7 && m.edge_count() == 11 && m.face_count() == 6));
  CHECK(faults(m) == "");
  CHECK(not_simple(m) == 0);
}

TEST_CASE("collapse_edge refuses what would make parallel edges or loops, it names the common neighbour") {
  // A prism over a triangle: the three edges that join its triangles are fine; the edges of a triangle too; but after the ends of a
  // tube of triangles are taken away (an hourglass), the waist is not.
  Mesh m = shapes::build(shapes::torus_builder(3, 7));  // the waist has three edges and no face inside
  REQUIRE(triangulate(m));
  const HalfedgeId waist = [&] {
    for (HalfedgeId h : halfedges(m)) {
      if (m.vertex(h) == VertexId{0} && m.target(h) == VertexId{1}) { return h; }
    }
    return HalfedgeId{};
  }();
  REQUIRE(waist.valid());
  const auto before = records(m);
  const auto refused = collapse_edge(m, waist);
  CHECK(refused.refusal().code == Code::link_condition);
  CHECK(refused.refusal().sentence().find("v2") != std::string::npos);
  CHECK(collapse_edge(m, HalfedgeId{}).refusal().code == Code::dead);
  CHECK(records(m) == before);
  Bare s;
  const HalfedgeId h = *make_segment(s);
  CHECK(collapse_edge(s, h).refusal().code == Code::last_edge);
  const HalfedgeId loop = *split_face(s, h, h);
  CHECK(collapse_edge(s, loop).refusal().code == Code::same_vertex);
  const HalfedgeId second = *split_face(s, h, twin(h));  // parallel to the segment
  CHECK(collapse_edge(s, second).refusal().code == Code::link_condition);
}

TEST_CASE("a tetrahedron collapses to a triangle with two faces, to a segment, and no further") {
  Mesh m = shapes::build(shapes::tetrahedron_builder());
  REQUIRE(collapse_edge(m, HalfedgeId{0}));
  CHECK((m.vertex_count() == 3 && m.edge_count() == 3 && m.face_count() == 2));
  CHECK(faults(m) == "");
  REQUIRE(collapse_edge(m, shapes::all_halfedges(m)[0]));
  CHECK((m.vertex_count() == 2 && m.edge_count() == 1 && m.face_count() == 1));
  CHECK(faults(m) == "");
  CHECK(collapse_edge(m, shapes::all_halfedges(m)[0]).refusal().code == Code::last_edge);
}

TEST_CASE("collapsing at random on triangles keeps a simple map simple, down to the least") {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Mesh m = shapes::build(seed % 2 == 0 ? shapes::torus_builder(5, 5) : shapes::prism_builder(12));
    REQUIRE(triangulate(m));
    const long handles = genus(m);
    for (int step = 0; step < 2000; ++step) {
      const auto all = shapes::all_halfedges(m);
      if (m.face_count() == 4) break;  // a tetrahedron goes on to a triangle, which is legal, but no longer a solid
      const auto before = records(m);
      if (!collapse_edge(m, all[random.below(all.size())])) {
        REQUIRE(records(m) == before);
        continue;
      }
      REQUIRE(faults(m) == "");
      REQUIRE((genus(m) == handles && not_simple(m) == 0));
      for (FaceId f : faces(m)) { REQUIRE(degree(m, f) == 3); }
    }
    CHECK(m.vertex_count() < 10);  // a torus needs 7 vertices
    CHECK(m.vertex_count() >= (handles == 1 ? 7 : 4));
  }
}

TEST_CASE("flip_edge between triangles: 2 flips turn the half-edge round, 4 restore every record but anchors, data included") {
  Mesh m = shapes::build(shapes::torus_builder(4, 5));
  REQUIRE(triangulate(m));
  for (FaceId f : faces(m)) { m.data(f).sheet = f.index; }
  for (HalfedgeId h : shapes::all_halfedges(m)) {
    Mesh copy = m;
    const VertexId v = m.vertex(h), w = m.target(h), x = m.target(m.next(h)), y = m.target(m.next(twin(h)));
    REQUIRE(*flip_edge(copy, h) == h);
    CHECK((copy.vertex(h) == y && copy.target(h) == x && copy.face(h) == m.face(h) && copy.face(twin(h)) == m.face(twin(h))));
    CHECK((degree(copy, copy.face(h)) == 3 && degree(copy, copy.face(twin(h))) == 3));
    REQUIRE(faults(copy) == "");
    for (FaceId f : faces(copy)) { REQUIRE(copy.data(f).sheet == f.index); }
    REQUIRE(flip_edge(copy, h));
    CHECK((copy.vertex(h) == w && copy.target(h) == v));
    REQUIRE(flip_edge(copy, h));
    REQUIRE(flip_edge(copy, h));
    for (HalfedgeId k : shapes::all_halfedges(m)) {
      REQUIRE((copy.next(k) == m.next(k) && copy.prev(k) == m.prev(k) && copy.vertex(k) == m.vertex(k) && copy.face(k) == m.face(k)));
    }
    REQUIRE(faults(copy) == "");
  }
}

TEST_CASE("flip_edge in any two faces: as many flips as their polygon has corners restore the map") {
  std::size_t flipped = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare m = calls::random_map<Bare>(random, 30);
    for (HalfedgeId h : shapes::all_halfedges(m)) {
      Bare copy = m;
      const auto before = records(m);
      const bool possible = m.face(h) != m.face(twin(h)) && m.next(h) != h && m.next(twin(h)) != twin(h);
      const std::size_t corners = degree(m, m.face(h)) + degree(m, m.face(twin(h))) - 2;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto result = flip_edge(copy, h);
        REQUIRE(result.has_value() == possible);
        REQUIRE(faults(copy) == "");
        if (possible) { continue; }
        REQUIRE(result.refusal().code == Code::cannot_flip);
        REQUIRE(records(copy) == before);
        ++refused;
        break;
      }
      for (HalfedgeId k : shapes::all_halfedges(m)) {
        REQUIRE((copy.next(k) == m.next(k) && copy.prev(k) == m.prev(k) && copy.vertex(k) == m.vertex(k) && copy.face(k) == m.face(k)));
      }
      flipped += possible ? 1 : 0;
    }
  }
  CHECK(flipped > 200);
  CHECK(refused > 200);
}

TEST_CASE("collapse_edge on random maps: legal results, no new parallel edges or loops, or a refusal that changes nothing") {
  std::size_t done = 0;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare m = calls::random_map<Bare>(random, 30);
    for (HalfedgeId h : shapes::all_halfedges(m)) {
      Bare copy = m;
      if (collapse_edge(copy, h)) {
        ++done;
        REQUIRE(faults(copy) == "");
        REQUIRE(genus(copy) == genus(m));
        REQUIRE(shell_count(copy) == shell_count(m));
        REQUIRE(not_simple(copy) <= not_simple(m));
      } else {
        REQUIRE(records(copy) == records(m));
      }
    }
  }
  CHECK(done > 500);
}
