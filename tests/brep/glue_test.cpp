// SPDX-License-Identifier: MIT
// Gluing two faces and punching holes: counts and genus, every way in which the faces can touch, random maps.

#include <brep/glue.hpp>

#include <brep/edit.hpp>
#include <brep/euler_log.hpp>
#include <brep/extrude.hpp>
#include <brep/shells.hpp>
#include <brep/triangulate.hpp>

#include "canonical.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::canonical;
using shapes::faults;
using shapes::Mesh;
using shapes::Random;
using shapes::records;
using Bare = BRep<>;
using Logged = BRep<NoData, NoData, NoData, EulerLog>;

namespace {

Builder several(const std::vector<std::pair<Builder, glm::dvec3>>& solids) {
  Builder b;
  for (const auto& [part, offset] : solids) {
    const auto base = static_cast<std::uint32_t>(b.vertex_count());
    for (std::uint32_t v = 0; v < part.vertex_count(); ++v) b.vertex(part.position(v) + offset);
    for (std::uint32_t f = 0; f < part.face_count(); ++f) {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t v : part.corners(f)) corners.push_back(base + v);
      b.face(corners, 0);
    }
  }
  return b;
}

// The half-edge on g that lies opposite to a, by positions.
HalfedgeId opposite(const Mesh& m, HalfedgeId a, FaceId g) {
  for (HalfedgeId c : halfedges_of(m, g)) {
    if (m.data(m.vertex(c)).position == m.data(m.target(a)).position && m.data(m.target(c)).position == m.data(m.vertex(a)).position)
      return c;
  }
  return {};
}

// The right answer by definition: the faces go, and twin(a_i) becomes the twin of twin(c_i). Vertices and faces are the orbits of what
// is left; only counts and words are compared, so the table of twins and successors is enough.
struct Table {
  std::vector<std::uint32_t> next, twin;
  std::vector<bool> alive;
};
std::vector<std::vector<std::uint32_t>> words_of(const Table& t) {
  std::vector<std::vector<std::uint32_t>> words;
  std::vector<bool> done(t.next.size(), false);
  for (std::uint32_t start = 0; start < t.next.size(); ++start) {
    if (!t.alive[start] || done[start]) continue;
    std::vector<std::uint32_t> members{start};
    done[start] = true;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::uint32_t y : {t.next[members[i]], t.twin[members[i]]}) {
        if (!done[y]) {
          done[y] = true;
          members.push_back(y);
        }
      }
    }
    std::vector<std::uint32_t> best, number(t.next.size());
    for (std::uint32_t root : members) {
      constexpr std::uint32_t none = 0xffffffff;
      for (std::uint32_t x : members) number[x] = none;
      std::vector<std::uint32_t> order{root}, word;
      number[root] = 0;
      for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::uint32_t y : {t.next[order[i]], t.twin[order[i]]}) {
          if (number[y] == none) {
            number[y] = static_cast<std::uint32_t>(order.size());
            order.push_back(y);
          }
          word.push_back(number[y]);
        }
      }
      if (best.empty() || word < best) best = word;
    }
    words.push_back(best);
  }
  std::sort(words.begin(), words.end());
  return words;
}
template <class B>
std::vector<std::vector<std::uint32_t>> glued_by_definition(const B& m, HalfedgeId a, HalfedgeId c) {
  Table t;
  t.next.resize(m.halfedge_end());
  t.twin.resize(m.halfedge_end());
  t.alive.assign(m.halfedge_end(), false);
  for (HalfedgeId h : shapes::all_halfedges(m)) {
    t.next[h.index] = m.next(h).index;
    t.twin[h.index] = twin(h).index;
    t.alive[h.index] = true;
  }
  const std::size_t n = degree(m, m.face(a));
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t x = t.twin[a.index], y = t.twin[c.index];
    // Beyond a and beyond c lie x and y, which become twins. Where x is c, nothing lies beyond.
    t.twin[x] = y;
    t.twin[y] = x;
    t.alive[a.index] = t.alive[c.index] = false;
    a = m.next(a);
    c = m.prev(c);
  }
  return words_of(t);
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
  for (FaceId f : faces(m)) CHECK((degree(m, f) == 4 && area(m, f) == 1.0));
}

TEST_CASE("gluing two faces of one shell makes a handle: a ring of eight cubes has genus 1") {
  std::vector<std::pair<Builder, glm::dvec3>> cubes;
  const std::vector<glm::dvec3> ring{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  for (const glm::dvec3& p : ring) cubes.push_back({shapes::cube_builder(), p});
  Mesh m = shapes::build(several(cubes));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    bool found = false;
    const auto in_cube = [&](FaceId f, std::size_t k) { return f.index / 6 == k; };
    for (FaceId f : faces(m)) {
      for (FaceId g : faces(m)) {
        if (found || !in_cube(f, i) || !in_cube(g, (i + 1) % ring.size())) continue;
        const HalfedgeId a = m.halfedge(f), c = opposite(m, a, g);
        if (!c.valid() || centroid(m, f) != centroid(m, g)) continue;
        REQUIRE(glue_faces(m, a, c));
        REQUIRE(faults(m) == "");
        found = true;
      }
    }
    REQUIRE(found);
  }
  CHECK((shell_count(m) == 1 && genus(m) == 1));
  // 16 outer and inner faces on the sides, 16 above and below; the vertices are those of a 3 x 3 grid of columns without inner ones: 4 x 4 x 2.
  CHECK((m.face_count() == 32 && m.vertex_count() == 32 && m.edge_count() == 64));
}

TEST_CASE("gluing is undone by cutting the seam: double its edges, split its vertices, join the belt, cut the last post") {
  Mesh m = shapes::build(several({{shapes::prism_builder(5), {0, 0, 0}}, {shapes::prism_builder(5), {0, 0, 1}}}));
  const auto two = canonical(m);
  const HalfedgeId a = m.halfedge(FaceId{1}), c = opposite(m, a, FaceId{7});
  REQUIRE(c.valid());
  REQUIRE(*glue_faces(m, a, c) == 5);
  CHECK(shell_count(m) == 1);
  std::vector<HalfedgeId> seam, doubles;
  for (HalfedgeId h = a; seam.empty() || h != a; h = m.next(twin(m.next(h)))) seam.push_back(h);  // straight on, the degree is four
  REQUIRE(seam.size() == 5);
  for (HalfedgeId h : seam) doubles.push_back(*split_face(m, h, m.next(h)));
  std::vector<HalfedgeId> posts;
  for (std::size_t i = 0; i < 5; ++i) posts.push_back(*split_vertex(m, seam[i], twin(doubles[(i + 4) % 5])));
  for (std::size_t i = 1; i < 5; ++i) REQUIRE(join_faces(m, posts[i]));
  REQUIRE(cut(m, posts[0]));
  CHECK(faults(m) == "");
  CHECK(canonical(m) == two);
}

TEST_CASE("the two sides of a sheet glued to each other vanish; the sides of a segment are one face and refused") {
  Mesh m = shapes::build(shapes::pillow_builder({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const HalfedgeId a = m.halfedge(FaceId{0});
  Mesh turned = m;
  REQUIRE(*glue_faces(m, a, twin(a)) == 0);
  CHECK((m.vertex_count() == 0 && m.edge_count() == 0 && m.face_count() == 0));
  CHECK(faults(m) == "");
  // Turned by one corner, each edge is glued to the next one: nothing is left but one edge, whose both ends are one vertex or two.
  const auto expected = glued_by_definition(turned, a, turned.next(twin(a)));
  REQUIRE(glue_faces(turned, a, turned.next(twin(a))));
  CHECK(faults(turned) == "");
  CHECK(canonical(turned) == expected);
  Bare s;
  const HalfedgeId h = *make_segment(s);
  CHECK(glue_faces(s, h, twin(h)).refusal().code == Code::equal_faces);
}

TEST_CASE("a hole punched through a cube: genus 1; through a cube with inset caps it has the right volume; and it is undone") {
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
    if (p.x == q.x && p.y == q.y) c = x;
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
  for (std::size_t i = 3; i > 0; --i) REQUIRE(join_faces(m, m.next(m.next(twin(rungs[i - 1])))));
  REQUIRE(cut(m, h));
  CHECK(genus(m) == 0);
  CHECK((m.vertex_count() == v && m.edge_count() == e && m.face_count() == f));
  CHECK(faults(m) == "");
}

TEST_CASE("punch_hole between two shells makes one; between faces that share a vertex or an edge it is legal") {
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

TEST_CASE("glue_faces on every pair of half-edges of random maps is what the definition says: faces gone, half-edges beyond joined") {
  std::size_t glued = 0, handles = 0, joined = 0, fell = 0, vanished = 0;
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Logged m = shapes::random_map<Logged>(random, 10 + static_cast<int>(random.below(16)));
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
        const auto expected = glued_by_definition(m, a, c);
        REQUIRE(canonical(copy) == expected);
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
    const Logged m = shapes::random_map<Logged>(random, 10 + static_cast<int>(random.below(16)));
    const auto all = shapes::all_halfedges(m);
    for (HalfedgeId a : all) {
      for (HalfedgeId c : all) {
        Logged copy = m;
        const auto h = punch_hole(copy, a, c);
        if (!h) continue;
        const std::size_t n = degree(m, m.face(a));
        REQUIRE(faults(copy) == "");
        REQUIRE((copy.vertex_count() == m.vertex_count() && copy.edge_count() == m.edge_count() + n));
        REQUIRE(copy.face_count() + 2 == m.face_count() + n);
        const auto joined = static_cast<long>(shell_count(m)) - static_cast<long>(shell_count(copy));
        REQUIRE(genus(copy) - genus(m) == 1 - joined);
        for (HalfedgeId x : halfedges_of(m, m.face(a))) REQUIRE(degree(copy, copy.face(x)) == 4);
        for (HalfedgeId x : halfedges_of(m, m.face(c))) REQUIRE(degree(copy, copy.face(x)) == 4);
        REQUIRE(copy.face(a) == copy.face(c));
        REQUIRE(undo_to(copy, mark(m)));
        REQUIRE(records(copy) == records(m));
      }
    }
  }
}

TEST_CASE("random sequences of composite operators: every state valid, refusals change nothing, the log takes all back") {
  std::size_t states = 0, refused = 0;
  long most_handles = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Logged m = shapes::random_map<Logged>(random, 20);
    const auto start = records(m);
    const std::size_t first = mark(m);
    for (int step = 0; step < 150; ++step) {
      const auto all = shapes::all_halfedges(m);
      if (all.empty()) break;
      const HalfedgeId a = all[random.below(all.size())], c = all[random.below(all.size())];
      const auto before = records(m);
      const long handles = genus(m);
      const std::size_t shells = shell_count(m);
      bool done = false;
      const std::uint32_t which = m.edge_count() < 150 ? random.below(7) : random.below(3);
      switch (which) {
        case 0:
          done = collapse_edge(m, a).has_value();
          break;
        case 1:
          done = glue_faces(m, a, c).has_value();
          break;
        case 2:
          done = flip_edge(m, a).has_value();
          break;
        case 3:
          done = extrude_face(m, m.face(a)).has_value();
          break;
        case 4:
          done = poke_face(m, m.face(a)).has_value();
          break;
        case 5:
          done = punch_hole(m, a, c).has_value();
          break;
        default:
          done = triangulate_face(m, m.face(a)).has_value();
          break;
      }
      if (!done) {
        ++refused;
        REQUIRE(records(m) == before);
        continue;
      }
      ++states;
      REQUIRE(faults(m) == "");
      if (which != 1 && which != 5) REQUIRE((genus(m) == handles && shell_count(m) == shells));
      REQUIRE(genus(m) >= 0);
      most_handles = std::max(most_handles, genus(m));
    }
    REQUIRE(undo_to(m, first));
    REQUIRE(records(m) == start);
  }
  CHECK(states > 2000);
  CHECK(refused > 500);
  CHECK(most_handles > 3);
}
