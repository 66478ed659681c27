// SPDX-License-Identifier: MIT
// The dual: roles exchanged, twice is the same map, operators and their duals commute with it, and its log tells how to make it.

#include <brep/dual.hpp>

#include <set>

#include <brep/euler_log.hpp>
#include <brep/replay.hpp>
#include <brep/shells.hpp>
#include <brep/testing.hpp>

#include "calls.hpp"
#include "maps.hpp"

using namespace brep;
using maps::Bare;
using shapes::Mesh;
using shapes::Random;

namespace {

using Logged = BRep<NoData, NoData, NoData, EulerLog>;

// The drawing in dual.hpp, half-edge by half-edge: with the counts it says all there is to say about a dual.
template <class B, class D>
void check_dual(const B& m, const Dual<D>& dual) {
  const auto image = [&](HalfedgeId h) { return dual.halfedge[h.index]; };
  const D& d = dual.brep;
  REQUIRE_THAT(d, IsValid());
  REQUIRE_THAT(d, HasCounts({.v = static_cast<long>(m.face_count()),
                             .e = static_cast<long>(m.edge_count()),
                             .f = static_cast<long>(m.vertex_count()),
                             .s = static_cast<long>(shell_count(m)),
                             .h = genus(m)}));
  std::set<HalfedgeId> images;
  for (HalfedgeId h : shapes::all_halfedges(m)) {
    REQUIRE(images.insert(image(h)).second);
    REQUIRE(image(twin(h)) == twin(image(h)));
    REQUIRE(d.next(image(h)) == image(m.prev(twin(h))));
    REQUIRE(d.vertex(image(h)) == dual.vertex_of_face[m.face(h).index]);
    REQUIRE(d.face(image(h)) == dual.face_of_vertex[m.target(h).index]);
  }
}

// The log of the dual makes it from nothing, and undone to nothing.
void check_log(const Logged& dual) {
  Logged replayed;
  REQUIRE(replay(steps(dual), replayed));
  REQUIRE(shapes::picture(replayed) == shapes::picture(dual));
  REQUIRE(undo_to(replayed, 0));
  REQUIRE(replayed.edge_count() == 0);
}

}  // namespace

TEST_CASE("the dual of a cube is an octahedron whose vertices lie in the middles of the faces") {
  const Mesh m = shapes::build(shapes::cube_builder());
  const Dual<Mesh> dual_m = dual(m);
  const Mesh& d = dual_m.brep;
  CHECK_THAT(d, HasCounts({.v = 6, .e = 12, .f = 8}));
  for (FaceId f : faces(m)) {
    const VertexId v = dual_m.vertex_of_face[f.index];
    CHECK(degree(d, v) == 4);
    CHECK(d.data(v).position == centroid(m, f));
  }
  const glm::dvec3 middle{0.5};
  for (VertexId v : vertices(m)) {
    const FaceId f = dual_m.face_of_vertex[v.index];
    CHECK(degree(d, f) == 3);
    CHECK(glm::dot(normal(d, f), m.data(v).position - middle) > 0.0);  // outward, on the side of the vertex
  }
}

TEST_CASE("the dual has all links exchanged, its log makes it from nothing, and the dual of the dual is the same map") {
  std::vector<Bare> all{shapes::build<Bare>(shapes::cube_builder()), shapes::build<Bare>(shapes::torus_builder(5, 4)), Bare{}};
  for (const maps::Level& level : maps::all_maps(4)) {
    for (const auto& [word, mesh] : level) { all.push_back(mesh); }
  }
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    all.push_back(calls::random_map<Bare>(random, 10 * seed));
  }
  long most_handles = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    INFO("map " << i);
    const Bare& m = all[i];
    const Dual<Logged> d = dual<Logged>(m);
    check_dual(m, d);
    check_log(d.brep);
    REQUIRE_THAT(dual(d.brep).brep, IsIsomorphicTo(m));
    // The dual by exchanging records is turned the other way.
    REQUIRE_THAT(d.brep, IsIsomorphicTo(maps::mirrored(maps::dual(m))));
    most_handles = std::max(most_handles, genus(m));
  }
  CHECK(most_handles > 5);
}

TEST_CASE("the dual of an operator is the dual operator on the dual: split_face and split_vertex, bridge and weld, joins, cut and unweld") {
  std::size_t done = 0;
  for (std::uint32_t seed = 1; seed <= 25; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare m = calls::random_map<Bare>(random, 20);
    const Dual<Bare> dual_m = dual(m);
    const Bare& d = dual_m.brep;
    const auto image = [&](HalfedgeId h) { return dual_m.halfedge[h.index]; };
    const auto same = [&](const Bare& x, bool x_done, const Bare& y, bool y_done) {
      REQUIRE(x_done == y_done);
      if (!x_done) { return; }
      ++done;
      REQUIRE_THAT(dual(x).brep, IsIsomorphicTo(y));
    };
    for (HalfedgeId a : shapes::all_halfedges(m)) {
      for (HalfedgeId b : shapes::all_halfedges(m)) {
        Bare x = m, y = d;
        // Around the dual vertex face(a), clockwise is backward on the loop: the dual corner before a is left by prev(a).
        const HalfedgeId p = image(m.prev(a)), q = image(m.prev(b));
        const bool split = split_face(x, a, b).has_value();
        same(x, split, y, split_vertex(y, p, q).has_value());
        x = m, y = d;
        const bool bridged = bridge(x, a, b).has_value();
        same(x, bridged, y, weld(y, p, q).has_value());
      }
      Bare x = m, y = d;
      const bool joined = join_faces(x, a).has_value();
      same(x, joined, y, join_vertices(y, image(a)).has_value());
      x = m, y = d;
      const bool cut_done = cut(x, a).has_value();
      same(x, cut_done, y, unweld(y, image(a)).has_value());
    }
  }
  CHECK(done > 2000);
}
