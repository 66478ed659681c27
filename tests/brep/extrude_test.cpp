// SPDX-License-Identifier: MIT
// Extrude, poke and triangulate: counts, inverses, data, degenerate faces.

#include <brep/extrude.hpp>

#include <algorithm>

#include <brep/euler_log.hpp>
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
using Logged = BRep<NoData, NoData, NoData, EulerLog>;

// By the divergence theorem, a pyramid over each face.
double volume(const Mesh& m) {
  double sum = 0.0;
  for (FaceId f : faces(m)) { sum += glm::dot(vector_area(m, f), positions(m, f)[0]); }
  return sum / 3.0;
}

std::vector<HalfedgeId> loop(const auto& m, FaceId f) {
  std::vector<HalfedgeId> all;
  for (HalfedgeId h : halfedges_of(m, f)) { all.push_back(h); }
  return all;
}

}  // namespace

TEST_CASE("extrude_face: the cap keeps its handle, each side is a quadrilateral above an old edge, and the volume is area times height") {
  for (std::uint32_t n : {3u, 4u, 7u}) {
    Mesh m = shapes::build(shapes::prism_builder(n));
    const FaceId top{1};
    m.data(top).label = 4;
    const auto old = loop(m, top);
    const double whole = volume(m), base = area(m, top);
    const std::size_t v = m.vertex_count(), e = m.edge_count(), f = m.face_count();
    REQUIRE(*extrude_face(m, top, glm::dvec3{0.1, 0.2, 2.5}) == top);
    CHECK((m.vertex_count() == v + n && m.edge_count() == e + 2 * n && m.face_count() == f + n));
    REQUIRE(faults(m) == "");
    CHECK(genus(m) == 0);
    const auto cap = loop(m, top);
    REQUIRE(cap.size() == n);
    for (std::size_t i = 0; i < n; ++i) {
      const FaceId side = m.face(twin(cap[i]));
      CHECK((degree(m, side) == 4 && m.data(side).label == 4 && m.data(side).sheet == 1));
      CHECK(m.next(m.next(twin(cap[i]))) == old[i]);
      const glm::dvec3 lifted = m.data(m.vertex(cap[i])).position - m.data(m.vertex(old[i])).position;
      CHECK(glm::distance(lifted, glm::dvec3{0.1, 0.2, 2.5}) < 1e-15);
    }
    // Sums of some 10 products of size <= 10: rounding below 1e-14.
    CHECK(volume(m) - whole == test::Approx(2.5 * base).epsilon(1e-13));
  }
}

TEST_CASE("extrude_face is undone by joins in the opposite order: every record is restored") {
  Random random(5);
  for (int round = 0; round < 40; ++round) {
    Bare m = calls::random_map<Bare>(random, 25);
    if (m.face_count() == 0) { continue; }
    const FaceId f = m.face(shapes::all_halfedges(m)[0]);
    const std::size_t n = degree(m, f);
    const auto before = records(m);
    const HalfedgeId old = m.halfedge(f);
    const auto cap = extrude_face(m, f);
    REQUIRE(cap);
    REQUIRE(faults(m) == "");
    if (n == 1) {  // the cap is the new face
      CHECK(*cap != f);
      const HalfedgeId collar = m.prev(old);
      REQUIRE(join_faces(m, twin(m.halfedge(*cap))));
      REQUIRE(join_vertices(m, twin(collar)));
      CHECK(records(m) == before);
      continue;
    }
    CHECK(*cap == f);
    std::vector<HalfedgeId> rims, collar;
    for (HalfedgeId h : halfedges_of(m, f)) {
      rims.push_back(h);
      collar.push_back(twin(m.next(twin(h))));  // up, at the start of h's end: sorted below
    }
    // Handles of new edges rise or come from free slots; the order of making is that of the loop from the anchor on.
    for (std::size_t i = n; i-- > 0;) { REQUIRE(join_faces(m, rims[i])); }
    std::vector<HalfedgeId> spurs;
    for (HalfedgeId h : halfedges_of(m, f)) {
      if (m.next(h) == twin(h) && std::find(collar.begin(), collar.end(), twin(h)) != collar.end()) { spurs.push_back(h); }
      if (m.next(h) == twin(h) && std::find(collar.begin(), collar.end(), h) != collar.end()) { spurs.push_back(h); }
    }
    REQUIRE(spurs.size() == n);
    // The loop starts at the old anchor, so its own spur comes last, and was made first.
    std::rotate(spurs.begin(), spurs.end() - 1, spurs.end());
    for (std::size_t i = n; i-- > 0;) { REQUIRE(join_vertices(m, spurs[i])); }
    CHECK(records(m) == before);
  }
}

TEST_CASE("poke_face: n triangles around the centroid, and joining the spokes gives the start") {
  for (std::uint32_t n : {3u, 4u, 9u}) {
    Mesh m = shapes::build(shapes::prism_builder(n));
    const FaceId top{1};
    m.data(top).label = 1;
    const auto before = records(m);
    const glm::dvec3 middle = centroid(m, top);
    const double whole = area(m, top);
    const VertexId centre = *poke_face(m, top);
    CHECK((m.vertex_count() == 2 * n + 1 && m.edge_count() == 4 * n && m.face_count() == 2 * n + 1));
    REQUIRE(faults(m) == "");
    CHECK(m.data(centre).position == middle);
    CHECK(degree(m, centre) == n);
    double sum = 0.0;
    std::vector<HalfedgeId> spokes;
    for (HalfedgeId h : halfedges_from(m, centre)) {
      CHECK((degree(m, m.face(h)) == 3 && m.data(m.face(h)).label == 1));
      sum += area(m, m.face(h));
      spokes.push_back(h);
    }
    CHECK(sum == test::Approx(whole).epsilon(1e-14));
    // Clockwise from the anchor of the centre, the first spoke: the first one, the last made, ..., the second.
    for (std::size_t i = 1; i < n; ++i) { REQUIRE(join_faces(m, spokes[i])); }
    REQUIRE(join_vertices(m, twin(spokes[0])));
    CHECK(records(m) == before);
  }
}

TEST_CASE("triangulate: n - 2 triangles for a face of n edges, the area is covered, all positively oriented") {
  Mesh m = shapes::build(shapes::prism_builder(17));
  const std::size_t f = m.face_count();
  const double whole = shapes::total_area(m), inside = volume(m);
  REQUIRE(*triangulate(m) == 2 * 14 + 17);
  CHECK(m.face_count() == f + 2 * 14 + 17);
  REQUIRE(faults(m) == "");
  for (FaceId g : faces(m)) { REQUIRE((degree(m, g) == 3 && area(m, g) > 0.0)); }
  CHECK(shapes::total_area(m) == test::Approx(whole).epsilon(1e-13));
  CHECK(volume(m) == test::Approx(inside).epsilon(1e-13));
  CHECK(*triangulate(m) == 0);
}

TEST_CASE("triangulate_face of polygons with straight corners and of random stars covers them") {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::vector<glm::dvec2> p;
    const unsigned n = 4 + random.below(30);
    for (unsigned i = 0; i < n; ++i) {
      const double a = 2.0 * shapes::pi * (i + 0.8 * random.unit()) / n, r = 0.2 + random.unit();
      p.push_back({r * std::cos(a), r * std::sin(a)});
      if (random.below(2) == 0 && i > 0) { p.insert(p.end() - 1, 0.5 * (p[p.size() - 1] + p[p.size() - 2])); }
    }
    Mesh m = shapes::build(shapes::pillow_builder(p));
    const double whole = area(m, FaceId{0});
    const auto parts = triangulate_face(m, FaceId{0});
    REQUIRE(parts);
    CHECK(parts->size() == p.size() - 2);
    double sum = 0.0;
    for (FaceId f : *parts) {
      REQUIRE(degree(m, f) == 3);
      REQUIRE(vector_area(m, f).z > 0.0);
      sum += area(m, f);
    }
    CHECK(sum == test::Approx(whole).epsilon(1e-12));
    REQUIRE(faults(m) == "");
  }
}

TEST_CASE("triangulate without positions cuts fans, faces of one and two edges stay, a crossed face is refused and nothing changes") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Bare m = calls::random_map<Bare>(random, 40);
    const std::size_t count = m.face_count();
    const auto added = triangulate(m);
    REQUIRE(added);
    CHECK(m.face_count() == count + *added);
    REQUIRE(faults(m) == "");
    for (FaceId f : faces(m)) { REQUIRE(degree(m, f) <= 3); }
  }
  Mesh crossed = shapes::build(shapes::prism_builder(5));
  std::swap(crossed.data(VertexId{5}).position, crossed.data(VertexId{6}).position);
  const auto before = records(crossed);
  CHECK(triangulate(crossed).refusal().code == Code::not_simple);
  CHECK(triangulate_face(crossed, FaceId{99}).refusal().code == Code::dead);
  CHECK(records(crossed) == before);
}

TEST_CASE("triangulate: of many faces the refusal names the one that cannot be cut, and neither records nor log change") {
  using LoggedMesh = BRep<shapes::Vertex, NoData, shapes::Face, EulerLog>;
  std::size_t refused_after_cuts = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    // A prism above a pentagon, and beside it a star so warped that its parts may cross themselves, with its back.
    Builder b = shapes::prism_builder(5);
    std::vector<std::uint32_t> star;
    for (unsigned i = 0; i < 9; ++i) {
      const double angle = 2.0 * shapes::pi * i / 9, r = 0.3 + random.unit();
      star.push_back(b.vertex({r * std::cos(angle), r * std::sin(angle), 20.0 * random.unit()}));
    }
    b.face(star, 0);
    std::reverse(star.begin(), star.end());
    b.face(star, 0);
    auto m = std::move(*close<LoggedMesh>(b).brep);
    const auto before = records(m);
    const auto all = triangulate(m);
    if (all) { continue; }
    CHECK(records(m) == before);
    CHECK(mark(m) == 0);
    if (all.refusal().code != Code::degenerate_polygon) { continue; }
    ++refused_after_cuts;
    REQUIRE(all.refusal().elements[0].index >= 7);
    const FaceId f{all.refusal().elements[0].index};
    CHECK_FALSE(triangulate_face(m, f));
    CHECK((records(m) == before && mark(m) == 0));
  }
  CHECK(refused_after_cuts > 0);
}

TEST_CASE("extrude and poke random maps: always valid, genus and shells kept, dead faces refused, the log takes all back") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Logged m = calls::random_map<Logged>(random, 30);
    if (m.face_count() == 0) { continue; }
    const auto before = records(m);
    const std::size_t start = mark(m);
    const long handles = genus(m);
    const std::size_t count = shell_count(m);
    for (int step = 0; step < 12; ++step) {
      const FaceId f{random.below(m.face_end())};
      const std::size_t v = m.vertex_count(), n = m.alive(f) ? degree(m, f) : 0;
      const bool poke = random.below(2) == 0;
      const bool done = poke ? poke_face(m, f).has_value() : extrude_face(m, f).has_value();
      REQUIRE(done == (n > 0));
      REQUIRE(m.vertex_count() == v + (!done ? 0 : poke ? 1 : n));
      REQUIRE(faults(m) == "");
    }
    CHECK((genus(m) == handles && shell_count(m) == count));
    REQUIRE(undo_to(m, start));
    CHECK(records(m) == before);
  }
}
