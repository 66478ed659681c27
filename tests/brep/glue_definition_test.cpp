// SPDX-License-Identifier: MIT
// Gluing and punching on every pair of half-edges: every way in which two faces can touch, against the definition.

#include <brep/glue.hpp>

#include <map>

#include <brep/euler_log.hpp>
#include <brep/shells.hpp>
#include <brep/testing.hpp>

#include "calls.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;
using shapes::Random;
using shapes::records;

namespace {

using Bare = BRep<>;
using Logged = BRep<NoData, NoData, NoData, EulerLog>;

// The right answer by definition: the faces go, and twin(a_i) becomes the twin of twin(c_i). Vertices and faces are the orbits of what
// is left. Each half-edge is named by that of m that it was.
template <class B>
Bare glued_by_definition(const B& m, HalfedgeId a, HalfedgeId c) {
  using brep::detail::Raw;
  std::map<HalfedgeId, HalfedgeId> partner, made;  // the twins, and the new handles
  for (HalfedgeId h : shapes::all_halfedges(m)) { partner[h] = twin(h); }
  for (std::size_t n = degree(m, m.face(a)); n > 0; --n, a = m.next(a), c = m.prev(c)) {
    // Beyond a and beyond c lie x and y, which become twins. Where x is c, nothing lies beyond.
    const HalfedgeId x = partner[a], y = partner[c];
    partner[x] = y;
    partner[y] = x;
    partner.erase(a);
    partner.erase(c);
  }
  Bare result;
  for (const auto& [h, t] : partner) {
    if (made.count(h) != 0) { continue; }
    made[h] = Raw::new_edge(result);
    made[t] = twin(made[h]);
  }
  for (const auto& [h, x] : made) { Raw::at(result, x) = {made[m.next(h)], made[m.prev(h)], {}, {}}; }
  for (const auto& [h, x] : made) {
    if (!result.face(x).valid()) { brep::detail::rename_loop(result, x, x, Raw::new_face(result)); }
    if (!result.vertex(x).valid()) { brep::detail::rename_orbit(result, x, x, Raw::new_vertex(result)); }
    Raw::at(result, result.face(x)).halfedge = x;
    Raw::at(result, result.vertex(x)).halfedge = x;
  }
  return result;
}

}  // namespace

TEST_CASE("the two sides of a sheet glued to each other vanish, the sides of a segment are one face and refused") {
  Mesh m = shapes::build(shapes::pillow_builder({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const HalfedgeId a = m.halfedge(FaceId{0});
  Mesh turned = m;
  REQUIRE(*glue_faces(m, a, twin(a)) == 0);
  CHECK((m.vertex_count() == 0 && m.edge_count() == 0 && m.face_count() == 0));
  CHECK(faults(m) == "");
  // Turned by one corner, each edge is glued to the next one: nothing is left but one edge, whose both ends are one vertex or two.
  const Bare expected = glued_by_definition(turned, a, turned.next(twin(a)));
  REQUIRE(glue_faces(turned, a, turned.next(twin(a))));
  CHECK(faults(turned) == "");
  CHECK_THAT(turned, IsIsomorphicTo(expected));
  Bare s;
  const HalfedgeId h = *make_segment(s);
  CHECK(glue_faces(s, h, twin(h)).refusal().code == Code::equal_faces);
}

TEST_CASE("glue_faces is what the definition says: faces gone, half-edges beyond joined, for every pair of half-edges of random maps") {
  std::size_t glued = 0, handles = 0, joined = 0, fell = 0, vanished = 0;
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Logged m = calls::random_map<Logged>(random, 10 + random.below(16));
    const auto all = shapes::all_halfedges(m);
    for (HalfedgeId a : all) {
      for (HalfedgeId c : all) {
        Logged copy = m;
        const auto result = glue_faces(copy, a, c);
        if (!result) {
          REQUIRE((m.face(a) == m.face(c) || degree(m, m.face(a)) != degree(m, m.face(c))));
          REQUIRE((result.refusal().code == Code::equal_faces || result.refusal().code == Code::different_degrees));
          REQUIRE(mark(copy) == mark(m));
          continue;
        }
        ++glued;
        REQUIRE(faults(copy) == "");
        const Bare expected = glued_by_definition(m, a, c);
        REQUIRE_THAT(copy, IsIsomorphicTo(expected));
        const long more = genus(copy) - genus(m);
        const auto shells_more = static_cast<long>(shell_count(copy)) - static_cast<long>(shell_count(m));
        handles += more > 0 ? 1 : 0;
        joined += shells_more < 0 && copy.vertex_count() > 0 ? 1 : 0;
        fell += shells_more > 0 ? 1 : 0;
        vanished += *result == 0 ? 1 : 0;
        REQUIRE(undo_to(copy, mark(m)));
        REQUIRE(records(copy) == records(m));
      }
    }
  }
  CAPTURE(glued, handles, joined, fell, vanished);
  CHECK(glued > 5000);
  CHECK((handles > 100 && joined > 100 && fell > 100 && vanished > 10));
}

TEST_CASE("punch_hole on every pair of half-edges of random maps: e + n, f + n - 2, quadrilaterals, one handle more or one shell less") {
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Logged m = calls::random_map<Logged>(random, 10 + random.below(16));
    const auto all = shapes::all_halfedges(m);
    for (HalfedgeId a : all) {
      for (HalfedgeId c : all) {
        Logged copy = m;
        const auto h = punch_hole(copy, a, c);
        if (!h) { continue; }
        const std::size_t n = degree(m, m.face(a));
        REQUIRE(faults(copy) == "");
        REQUIRE((copy.vertex_count() == m.vertex_count() && copy.edge_count() == m.edge_count() + n));
        REQUIRE(copy.face_count() + 2 == m.face_count() + n);
        const auto joined = static_cast<long>(shell_count(m)) - static_cast<long>(shell_count(copy));
        REQUIRE(genus(copy) - genus(m) == 1 - joined);
        for (HalfedgeId x : halfedges_of(m, m.face(a))) { REQUIRE(degree(copy, copy.face(x)) == 4); }
        for (HalfedgeId x : halfedges_of(m, m.face(c))) { REQUIRE(degree(copy, copy.face(x)) == 4); }
        REQUIRE(copy.face(a) == copy.face(c));
        REQUIRE(undo_to(copy, mark(m)));
        REQUIRE(records(copy) == records(m));
      }
    }
  }
}
