// SPDX-License-Identifier: MIT
// Isomorphism of BReps and the matchers of brep/testing.hpp, which other people's tests rely on.

#include <brep/isomorphism.hpp>

#include <sstream>

#include <brep/euler_log.hpp>
#include <brep/testing.hpp>

#include "calls.hpp"
#include "maps.hpp"

using namespace brep;
using maps::Bare;

namespace {

// A renaming keeps next and twin (or exchanges next and prev), and no two half-edges have one image.
void check_image(const Bare& a, const Bare& b, const std::vector<HalfedgeId>& image, Orientation orientation) {
  std::vector<bool> hit(b.halfedge_end(), false);
  for (HalfedgeId h : shapes::all_halfedges(a)) {
    const HalfedgeId x = image[h.index];
    REQUIRE(b.alive(x));
    REQUIRE_FALSE(hit[x.index]);
    hit[x.index] = true;
    REQUIRE(image[twin(h).index] == twin(x));
    REQUIRE(image[a.next(h).index] == (orientation == Orientation::kept ? b.next(x) : b.prev(x)));
  }
}

// The same BRep with other names for everything: the elements shuffled, half of the edges turned round.
Bare renamed(const Bare& mesh, shapes::Random& random) {
  using detail::Raw;
  Bare result;
  const auto shuffled = [&](auto&& range) {
    std::vector<std::decay_t<decltype(*range.begin())>> order;
    for (auto id : range) { order.insert(order.begin() + random.below(order.size() + 1), id); }
    return order;
  };
  std::map<HalfedgeId, HalfedgeId> h;
  std::map<VertexId, VertexId> v;
  std::map<FaceId, FaceId> f;
  for (EdgeId e : shuffled(edges(mesh))) {
    const HalfedgeId x = random.below(2) == 0 ? halfedge(e) : twin(halfedge(e));
    h[x] = Raw::new_edge(result);
    h[twin(x)] = twin(h[x]);
  }
  for (VertexId x : shuffled(vertices(mesh))) { Raw::at(result, v[x] = Raw::new_vertex(result)).halfedge = h[mesh.halfedge(x)]; }
  for (FaceId x : shuffled(faces(mesh))) { Raw::at(result, f[x] = Raw::new_face(result)).halfedge = h[mesh.halfedge(x)]; }
  for (const auto& [old, made] : h) {
    Raw::at(result, made) = {h[mesh.next(old)], h[mesh.prev(old)], v[mesh.vertex(old)], f[mesh.face(old)]};
  }
  return result;
}

// m x n quadrilaterals on a torus whose seam is glued with a shift.
Bare twisted_torus(std::uint32_t m, std::uint32_t n, std::uint32_t shift) {
  Builder b;
  for (std::uint32_t i = 0; i < m * n; ++i) { b.vertex({i % m, i / m, 0}); }
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return y % n * m + (x + (y >= n ? shift : 0)) % m; };
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < m; ++x) { b.face({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}, 0); }
  }
  return shapes::build<Bare>(b);
}

template <class Matcher, class B>
std::string report(const Matcher& matcher, const B& mesh) {
  CHECK_FALSE(matcher.match(mesh));
  return matcher.toString();
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("maps of up to four edges are isomorphic exactly when their canonical words agree, mirrored ones too") {
  for (const maps::Level& level : maps::all_maps(4)) {
    for (const auto& [word, a] : level) {
      const Bare image = maps::mirrored(a);
      REQUIRE_THAT(image, IsValid());
      const maps::Word image_word = maps::canonical(image).word;
      for (const auto& [other_word, b] : level) {
        CHECK(find_isomorphism(a, b).has_value() == (word == other_word));
        CHECK(find_isomorphism(a, b, Orientation::reversed).has_value() == (image_word == other_word));
      }
    }
  }
}

TEST_CASE("a renamed BRep of many shells and handles is isomorphic to itself, and its mirror image in reverse") {
  int chiral = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Bare a;
    const std::size_t limit = 4 + random.below(60);
    for (int i = 0; i < 200; ++i) { calls::apply(a, calls::random_call(a, random, limit)); }
    const Bare b = renamed(a, random), c = maps::mirrored(b);
    REQUIRE_THAT(b, IsValid());
    const auto image = find_isomorphism(a, b);
    REQUIRE(image.has_value());
    check_image(a, b, *image, Orientation::kept);
    const auto reversed = find_isomorphism(a, c, Orientation::reversed);
    REQUIRE(reversed.has_value());
    check_image(a, c, *reversed, Orientation::reversed);
    if (find_isomorphism(a, c)) { continue; }
    ++chiral;
    if (!difference(a, c).empty()) { CHECK(has(difference(a, c), "mirror image")); }
  }
  CHECK(chiral > 20);
}

TEST_CASE("tori of thousands of edges that look alike everywhere are told apart by how they close") {
  // All vertices and faces have degree 4, so every half-edge has the same colour and every image must be tried.
  const Bare straight = twisted_torus(40, 40, 0), same = twisted_torus(40, 40, 40), twisted = twisted_torus(40, 40, 7);
  CHECK_THAT(straight, HasCounts({.v = 1600, .e = 3200, .f = 1600, .s = 1, .h = 1}));
  CHECK_THAT(same, IsIsomorphicTo(straight));
  CHECK_THAT(twisted, !IsIsomorphicTo(straight));
  CHECK(has(report(IsIsomorphicTo(straight), twisted), "connected differently"));
  CHECK(has(report(IsIsomorphicTo(twisted), twisted_torus(40, 40, 33)), "mirror image"));  // a shift by -7
}

TEST_CASE("IsValid prints the faults, and those of the constraints when they are asked for") {
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  CHECK_THAT(m, IsValid());
  CHECK_THAT(m, IsValid(Constraint::polyhedron));
  REQUIRE(split_edge(m, HalfedgeId{0}));
  CHECK_THAT(m, IsValid());
  CHECK(has(report(IsValid(Constraint::polyhedron), m), "\nR15: only 2 half-edges leave v8"));
  detail::Raw::at(m, HalfedgeId{0}).face = FaceId{50};
  CHECK(has(report(IsValid(), m), "\nR1: h0 has the face f50"));
  const IsValid again;
  CHECK_FALSE(again.match(m));
  CHECK(again.match(shapes::build(shapes::cube_builder())));
  CHECK(again.toString() == "is valid");  // the report is that of the last match
}

TEST_CASE("HasCounts compares what is given, prints all of it, and does not flood a damaged BRep") {
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  CHECK_THAT(m, HasCounts({.v = 8, .e = 12, .f = 6, .s = 1, .h = 0}));
  CHECK_THAT(m, HasCounts({.f = 6}));
  CHECK_THAT(m, (HasCounts{.v = 8, .h = 0}));
  CHECK(report(HasCounts({.v = 8, .e = 13, .h = 1}), m) == "has the counts\nv = 8\ne = 12, expected 13\nh = 0, expected 1");
  detail::Raw::at(m, HalfedgeId{0}).next = HalfedgeId{70};
  CHECK_THAT(m, HasCounts({.v = 8}));
  CHECK(has(report(HasCounts({.v = 8, .s = 1}), m), "cannot be counted:\nR1"));
}

TEST_CASE("IsIsomorphicTo compares BReps of any types, and says what differs") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder());
  CHECK_THAT(shapes::build(shapes::cube_builder()), IsIsomorphicTo(cube));
  CHECK_THAT((BRep<NoData, NoData, NoData, EulerLog>{}), IsIsomorphicTo(Bare{}));
  CHECK_THAT(shapes::build(shapes::prism_builder(4)), IsIsomorphicTo(cube));
  const std::string text = report(IsIsomorphicTo(cube), shapes::build(shapes::prism_builder(3)));
  CHECK(has(text, "vertices: 6 of degree 3, expected 8 of degree 3"));
  CHECK(has(text, "faces: 2 of degree 3, 3 of degree 4, expected 6 of degree 4"));
  CHECK(has(report(IsIsomorphicTo(maps::together(cube, cube)), cube), "shells: 1, expected 2"));
  Bare broken = cube;
  detail::Raw::at(broken, HalfedgeId{0}).next = HalfedgeId{0};
  CHECK(has(report(IsIsomorphicTo(cube), broken), "R3"));
  CHECK(has(report(IsIsomorphicTo(broken), cube), "that one is not valid"));
  CHECK(report(!IsIsomorphicTo(cube), cube) == "not: is isomorphic to the expected one");
}

TEST_CASE("Catch2 prints a BRep with its counts") {
  std::ostringstream out;
  out << shapes::build<Bare>(shapes::cube_builder());
  CHECK(out.str() == "the BRep with v = 8, e = 12, f = 6");
}
