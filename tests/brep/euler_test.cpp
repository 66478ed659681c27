// SPDX-License-Identifier: MIT
// Euler operators one by one, on solids that can be drawn. All small solids: exhaustive_test.cpp; long sequences: random_test.cpp;
// faces against vertices: duality_test.cpp.

#include <brep/euler.hpp>

#include <brep/testing.hpp>

#include "shapes.hpp"

using namespace brep;
using shapes::all_halfedges;
using shapes::picture;
using shapes::Random;

namespace {

using Bare = BRep<>;

}  // namespace

TEST_CASE("make_segment makes the smallest shell, kill_segment removes it and the next one gets the same handles") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  CHECK_THAT(m, HasCounts({.v = 2, .e = 1, .f = 1, .s = 1, .h = 0}));
  CHECK((m.next(h) == twin(h) && m.next(twin(h)) == h && m.face(h) == m.face(twin(h))));
  CHECK_THAT(m, IsValid());
  const auto before = picture(m);
  REQUIRE(kill_segment(m, h));
  CHECK((m.vertex_count() == 0 && !m.alive(h) && !m.alive(twin(h)) && !m.alive(edge(h)) && !m.alive(VertexId{0})));
  CHECK(*make_segment(m) == h);
  CHECK(picture(m) == before);
}

TEST_CASE("split_face then join_faces restores every record of a cube, anchors included") {
  const auto m = shapes::build(shapes::cube_builder());
  for (FaceId f : faces(m)) {
    for (HalfedgeId a : halfedges_of(m, f)) {
      auto copy = m;
      const HalfedgeId h = *split_face(copy, a, m.next(m.next(a)));
      CHECK_THAT(copy, HasCounts({.v = 8, .e = 13, .f = 7}));
      REQUIRE(join_faces(copy, h));
      CHECK(picture(copy) == picture(m));
    }
  }
}

TEST_CASE("bridge joins two cubes or gives one a handle, cut takes either back") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder());
  const FaceId bottom{0}, top{1};
  Bare m = cube;
  const HalfedgeId h = *bridge(m, m.halfedge(bottom), m.halfedge(top));
  CHECK_THAT(m, HasCounts({.v = 8, .e = 13, .f = 5, .s = 1, .h = 1}));
  CHECK(degree(m, bottom) == 4 + 1 + 4 + 1);
  CHECK(m.face(h) == bottom);
  CHECK_FALSE(m.alive(top));
  CHECK(*cut(m, h) == top);
  CHECK_THAT(m, IsIsomorphicTo(cube));

  const HalfedgeId segment = *make_segment(m);
  const HalfedgeId joint = *bridge(m, m.halfedge(bottom), segment);
  CHECK_THAT(m, HasCounts({.v = 10, .e = 14, .f = 6, .s = 1, .h = 0}));
  REQUIRE(cut(m, joint));
  CHECK_THAT(m, HasCounts({.s = 2, .h = 0}));
  REQUIRE(kill_segment(m, segment));
  CHECK_THAT(m, IsIsomorphicTo(cube));
}

TEST_CASE("weld unites two corners of a cube by a loop edge, and unweld parts them") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder());
  Bare m = cube;
  const HalfedgeId a = m.halfedge(VertexId{0}), b = m.halfedge(VertexId{7});
  const HalfedgeId h = *weld(m, a, b);
  CHECK_THAT(m, HasCounts({.v = 7, .e = 13, .f = 6, .s = 1, .h = 1}));
  CHECK(degree(m, VertexId{0}) == 3 + 3 + 2);
  CHECK((m.next(h) == a && m.next(twin(h)) == b && m.vertex(h) == m.target(h)));
  CHECK(*unweld(m, h) == VertexId{7});
  CHECK_THAT(m, IsIsomorphicTo(cube));
}

TEST_CASE("a torus comes down to one vertex, two edges and one face by joins, which keep the handle, then only cut or unweld go on") {
  auto m = shapes::build<Bare>(shapes::torus_builder(3, 4));
  Random random(7);
  while (m.edge_count() > 2) {
    const auto all = all_halfedges(m);
    const HalfedgeId h = all[random.below(all.size())];
    if (!(random.below(2) == 0 ? join_vertices(m, h).has_value() : join_faces(m, h).has_value())) { continue; }
    REQUIRE_THAT(m, IsValid());
    REQUIRE(genus(m) == 1);
  }
  CHECK_THAT(m, HasCounts({.v = 1, .e = 2, .f = 1}));
  for (HalfedgeId h : all_halfedges(m)) {
    CHECK(join_faces(m, h).refusal().code == Code::same_face);
    CHECK(join_vertices(m, h).refusal().code == Code::same_vertex);
    CHECK(kill_segment(m, h).refusal().code == Code::not_a_segment);
    Bare sphere = m, other = m;
    REQUIRE(cut(sphere, h));
    CHECK_THAT(sphere, HasCounts({.v = 1, .e = 1, .f = 2, .s = 1, .h = 0}));
    REQUIRE(unweld(other, h));
    CHECK_THAT(other, HasCounts({.v = 2, .e = 1, .f = 1, .s = 1, .h = 0}));
  }
}

TEST_CASE("dead and invalid handles are refused by every operator, with a sentence that names them") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  const HalfedgeId n = *split_edge(m, h);
  REQUIRE(join_vertices(m, twin(n)));
  const auto before = picture(m);
  for (HalfedgeId bad : {n, HalfedgeId{}, HalfedgeId{100}}) {
    CHECK(split_face(m, bad, h).refusal().code == Code::dead);
    CHECK(split_face(m, h, bad).refusal().code == Code::dead);
    CHECK(split_vertex(m, bad, h).refusal().code == Code::dead);
    CHECK(split_vertex(m, h, bad).refusal().code == Code::dead);
    CHECK(bridge(m, bad, h).refusal().code == Code::dead);
    CHECK(bridge(m, h, bad).refusal().code == Code::dead);
    CHECK(weld(m, bad, h).refusal().code == Code::dead);
    CHECK(weld(m, h, bad).refusal().code == Code::dead);
    CHECK(split_edge(m, bad).refusal().code == Code::dead);
    CHECK(join_faces(m, bad).refusal().code == Code::dead);
    CHECK(join_vertices(m, bad).refusal().code == Code::dead);
    CHECK(cut(m, bad).refusal().code == Code::dead);
    CHECK(unweld(m, bad).refusal().code == Code::dead);
    CHECK(kill_segment(m, bad).refusal().code == Code::dead);
  }
  CHECK(split_edge(m, n).refusal().sentence().find(to_string(n)) == 0);
  CHECK(picture(m) == before);
}

TEST_CASE("first_side_is_shorter tells which side split_face(a, b) would relabel") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  for (int i = 0; i < 20; ++i) { REQUIRE(split_edge(m, h)); }
  for (HalfedgeId a : all_halfedges(m)) {
    std::size_t way = 0;
    const std::size_t n = degree(m, m.face(a));
    for (HalfedgeId b = a; way < n; b = m.next(b), ++way) { CHECK(first_side_is_shorter(m, a, b) == (2 * way <= n)); }
  }
}
