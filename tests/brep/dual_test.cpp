// SPDX-License-Identifier: MIT
// The dual: roles exchanged, twice is the same map, operators and their duals commute with it.

#include <brep/dual.hpp>

#include <brep/edit.hpp>
#include <brep/euler.hpp>
#include <brep/glue.hpp>

#include "canonical.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::canonical;
using shapes::faults;
using shapes::Mesh;
using shapes::Random;
using Bare = BRep<>;

TEST_CASE("the dual of a cube is an octahedron whose vertices lie in the middles of the faces") {
  const Mesh m = shapes::build(shapes::cube_builder());
  const Mesh d = dual(m);
  CHECK((d.vertex_count() == 6 && d.edge_count() == 12 && d.face_count() == 8));
  CHECK(faults(d) == "");
  for (FaceId f : faces(m)) {
    CHECK(degree(d, VertexId{f.index}) == 4);
    CHECK(d.data(VertexId{f.index}).position == centroid(m, f));
  }
  const glm::dvec3 middle{0.5};
  for (FaceId f : faces(d)) {
    CHECK(degree(d, f) == 3);
    // Outward, on the side of the vertex that it is the dual of.
    CHECK(glm::dot(normal(d, f), m.data(VertexId{f.index}).position - middle) > 0.0);
  }
  CHECK(canonical(dual(d)) == canonical(m));
}

TEST_CASE("dual(dual(m)) is m with every half-edge in the place of its twin; genus and shells stay; free slots too") {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare m = shapes::random_map<Bare>(random, 40);
    const Bare d = dual(m), dd = dual(d);
    REQUIRE(faults(d) == "");
    REQUIRE(faults(dd) == "");
    CHECK((d.vertex_count() == m.face_count() && d.face_count() == m.vertex_count() && d.edge_count() == m.edge_count()));
    CHECK((genus(d) == genus(m) && shell_count(d) == shell_count(m)));
    CHECK((d.vertex_end() == m.face_end() && d.face_end() == m.vertex_end() && d.halfedge_end() == m.halfedge_end()));
    for (FaceId f : faces(m)) CHECK(degree(d, VertexId{f.index}) == degree(m, f));
    for (VertexId v : vertices(m)) CHECK(degree(d, FaceId{v.index}) == degree(m, v));
    for (HalfedgeId h : shapes::all_halfedges(m)) {
      REQUIRE((dd.next(h) == twin(m.prev(twin(h))) || dd.next(twin(h)) == twin(m.next(h))));
      REQUIRE((dd.vertex(h) == m.target(h) && dd.face(h) == m.face(twin(h))));
      REQUIRE(dd.vertex(twin(h)) == m.vertex(h));
    }
    CHECK(canonical(dd) == canonical(m));
  }
}

TEST_CASE("the dual of an operator is the dual operator on the dual: split_face and split_vertex, bridge and weld, joins, cut and unweld") {
  std::size_t done = 0;
  for (std::uint32_t seed = 1; seed <= 25; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare m = shapes::random_map<Bare>(random, 20);
    const Bare d = dual(m);
    const auto same = [&](const Bare& x, bool x_done, const Bare& y, bool y_done) {
      REQUIRE(x_done == y_done);
      if (!x_done) return;
      ++done;
      REQUIRE(canonical(dual(x)) == canonical(y));
    };
    for (HalfedgeId a : shapes::all_halfedges(m)) {
      for (HalfedgeId b : shapes::all_halfedges(m)) {
        Bare x = m, y = d;
        // Around the dual vertex face(a), clockwise is backward on the loop: the dual corner before a is left by prev(a).
        const HalfedgeId p = m.prev(a), q = m.prev(b);
        const bool split = split_face(x, a, b).has_value();
        same(x, split, y, split_vertex(y, p, q).has_value());
        x = m, y = d;
        const bool bridged = bridge(x, a, b).has_value();
        same(x, bridged, y, weld(y, p, q).has_value());
      }
      Bare x = m, y = d;
      const bool joined = join_faces(x, a).has_value();
      same(x, joined, y, join_vertices(y, a).has_value());
      x = m, y = d;
      const bool cut_done = cut(x, a).has_value();
      same(x, cut_done, y, unweld(y, a).has_value());
    }
  }
  CHECK(done > 2000);
}
