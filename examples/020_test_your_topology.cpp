// SPDX-License-Identifier: MIT
// Unit tests for your own topology code. Somebody writes an operator of their own: inset_face draws a smaller face inside a face and joins
// corner to corner. How can we know that it is right? We say what must be true afterwards and let Catch2 ask. The matchers of
// brep/testing.hpp know what a sound BRep is, count, and compare shapes; when a test fails they print in sentences what is wrong and where.

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif

#include <vector>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/testing.hpp>

using namespace brep;

// The operator under test. A spur grows from each corner into the face, then an edge runs from tip to tip.
static FaceId inset_face(BRep<>& solid, FaceId face) {
  std::vector<HalfedgeId> corners, spurs;
  for (HalfedgeId h : halfedges_of(solid, face)) { corners.push_back(h); }
  for (HalfedgeId c : corners) { spurs.push_back(*split_vertex(solid, c, c)); }
  // The first rim edge leaves the last tip; where it begins is where the last rim edge has to arrive.
  HalfedgeId rim;
  for (std::size_t i = 0; i < spurs.size(); ++i) {
    const HalfedgeId h = *split_face(solid, twin(spurs[i]), i + 1 < spurs.size() ? twin(spurs[i + 1]) : rim);
    if (i == 0) { rim = h; }
  }
  return solid.face(rim);
}

// A mistake that is easily made: a record is written by hand, and one of the two links is forgotten.
static void turn_badly(BRep<>& solid, HalfedgeId h) { detail::Raw::at(solid, h).next = solid.next(solid.next(h)); }

// A polygon with n corners and its back side: the smallest solid with an n-gon.
static BRep<> pillow(int n) {
  BRep<> solid;
  const HalfedgeId first = *make_segment(solid);
  HalfedgeId last = first;
  for (int i = 2; i < n; ++i) { last = *split_edge(solid, last); }
  (void)split_face(solid, twin(last), first);
  return solid;
}

TEST_CASE("inset_face keeps the solid valid and adds n vertices, 2n edges and n faces") {
  for (int n = 3; n < 8; ++n) {
    BRep<> solid = pillow(n);
    REQUIRE_THAT(solid, HasCounts({.v = n, .e = n, .f = 2, .s = 1, .h = 0}));
    const FaceId inner = inset_face(solid, *faces(solid).begin());
    CHECK_THAT(solid, IsValid());
    CHECK_THAT(solid, IsValid(Constraint::polygons));  // no spurs are left, all faces are simple polygons
    CHECK_THAT(solid, HasCounts({.v = 2 * n, .e = 3 * n, .f = n + 2, .s = 1, .h = 0}));
    CHECK(degree(solid, inner) == static_cast<std::size_t>(n));
  }
}

TEST_CASE("inset_face of a square pillow is a cube, whichever side is chosen") {
  BRep<> one = pillow(4), other = pillow(4);
  inset_face(one, FaceId{0});
  inset_face(other, FaceId{1});
  CHECK_THAT(other, IsIsomorphicTo(one));
  CHECK_THAT(one, IsValid(Constraint::polyhedron));
  CHECK_THAT(one, !IsIsomorphicTo(pillow(4)));
}

TEST_CASE("a broken solid is found out, and the report says where to look") {
  BRep<> solid = pillow(4);
  turn_badly(solid, HalfedgeId{0});
  const IsValid is_valid;
  CHECK_FALSE(is_valid.match(solid));  // CHECK_THAT(solid, IsValid()) would print this:
  CHECK(is_valid.toString() ==
        "is valid\n"
        "R3: next(h0) is h5, but prev(h5) is h3; usually one of the two links was not set\n"
        "R2: h0 ends at v2, but its next, h5, starts at v3; usually a vertex that was changed at a part of its half-edges\n"
        "R3: prev(h3) is h0, but next(h0) is h5; usually one of the two links was not set");
}
