// SPDX-License-Identifier: MIT
// Euler operators: inverses, refusals, all small maps, long random sequences.

#include <brep/euler.hpp>

#include <map>
#include <set>

#include "shapes.hpp"

using namespace brep;
using shapes::all_halfedges;
using shapes::faults;
using shapes::Random;
using shapes::records;

namespace {

// Data that own memory: leaks and uses after kill show under the address sanitizer.
struct Heavy {
  std::vector<int> list{1, 2, 3};
};
using Bare = BRep<>;
using HeavyMesh = BRep<Heavy, Heavy, Heavy>;

// The same word for two BReps of one shell exactly when an orientation-preserving renaming maps one to the other: number the
// half-edges in the order in which next and twin reach them from a root, write the links down, take the least word of all roots.
std::vector<std::uint32_t> canonical(const Bare& mesh) {
  std::vector<std::uint32_t> best;
  for (HalfedgeId root : all_halfedges(mesh)) {
    std::map<HalfedgeId, std::uint32_t> number{{root, 0}};
    std::vector<HalfedgeId> order{root};
    std::vector<std::uint32_t> word;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (HalfedgeId h : {mesh.next(order[i]), twin(order[i])}) {
        const auto found = number.emplace(h, static_cast<std::uint32_t>(order.size()));
        if (found.second) order.push_back(h);
        word.push_back(found.first->second);
      }
    }
    if (best.empty() || word < best) best = word;
  }
  return best;
}

void check_refusal(const Bare& before, const Bare& after, const Refusal& refusal) {
  CHECK(records(before) == records(after));
  CHECK_FALSE(refusal.sentence().empty());
  CHECK(refusal.code != Code::none);
}

// Applies every operator to every half-edge or pair: the result is valid, the counts are those of the operator's comment, the
// inverse restores every record; or the refusal changes nothing. Returns all results of the splitting operators.
std::vector<Bare> try_everything(const Bare& start) {
  std::vector<Bare> grown;
  const auto before = records(start);
  const std::size_t v = start.vertex_count(), e = start.edge_count(), f = start.face_count();
  const auto check_counts = [&](const Bare& m, int dv, int de, int df) {
    CHECK(faults(m) == "");
    CHECK(static_cast<int>(m.vertex_count()) == static_cast<int>(v) + dv);
    CHECK(static_cast<int>(m.edge_count()) == static_cast<int>(e) + de);
    CHECK(static_cast<int>(m.face_count()) == static_cast<int>(f) + df);
    CHECK(genus(m) == 0);
  };
  for (HalfedgeId a : all_halfedges(start)) {
    for (HalfedgeId b : all_halfedges(start)) {
      INFO(to_string(a) << " " << to_string(b));
      Bare m = start;
      if (const auto h = split_face(m, a, b)) {
        CHECK(start.face(a) == start.face(b));
        check_counts(m, 0, 1, 1);
        CHECK(m.vertex(*h) == start.vertex(a));
        CHECK(m.target(*h) == start.vertex(b));
        CHECK(m.face(*h) == start.face(b));
        CHECK(m.face(twin(*h)) != start.face(a));
        if (a == b)
          CHECK(m.next(twin(*h)) == twin(*h));
        else
          CHECK((m.next(*h) == b && m.next(twin(*h)) == a));
        grown.push_back(m);
        CHECK(join_faces(m, *h).has_value());
        CHECK(records(m) == before);
      } else {
        CHECK(h.refusal().code == Code::different_faces);
        check_refusal(start, m, h.refusal());
      }
      m = start;
      if (const auto h = split_vertex(m, a, b)) {
        CHECK(start.vertex(a) == start.vertex(b));
        check_counts(m, 1, 1, 0);
        CHECK(m.vertex(*h) == start.vertex(b));
        CHECK(m.target(*h) != start.vertex(b));
        CHECK((m.face(*h) == start.face(a) && m.face(twin(*h)) == start.face(b)));
        CHECK(m.next(*h) == (a == b ? twin(*h) : a));
        CHECK(m.next(twin(*h)) == b);
        grown.push_back(m);
        CHECK(join_vertices(m, *h).has_value());
        CHECK(records(m) == before);
      } else {
        CHECK(h.refusal().code == Code::different_vertices);
        check_refusal(start, m, h.refusal());
      }
    }
    INFO(to_string(a));
    Bare m = start;
    const auto n = split_edge(m, a);
    REQUIRE(n.has_value());
    check_counts(m, 1, 1, 0);
    CHECK((m.next(a) == *n && m.vertex(a) == start.vertex(a) && m.target(*n) == start.target(a)));
    CHECK(m.halfedge(m.vertex(*n)).valid());
    grown.push_back(m);
    CHECK(join_vertices(m, twin(*n)).has_value());
    CHECK(records(m) == before);

    m = start;
    const HalfedgeId t = twin(a), na = start.next(a), nt = start.next(t);
    if (const auto g = join_faces(m, a)) {
      check_counts(m, 0, -1, -1);
      CHECK(*g == start.face(a));
      CHECK_FALSE(m.alive(a));
      const HalfedgeId p = nt == t ? na : nt, q = na == a ? nt : na;
      const auto h = split_face(m, p, q);
      REQUIRE(h.has_value());
      CHECK(canonical(m) == canonical(start));
      if (na != a && a.index % 2 == 0) {  // every half-edge has its old record again; anchors need not be the old ones
        for (HalfedgeId x : all_halfedges(start)) {
          CHECK((m.next(x) == start.next(x) && m.prev(x) == start.prev(x) && m.vertex(x) == start.vertex(x) && m.face(x) == start.face(x)));
        }
      }
    } else {
      check_refusal(start, m, g.refusal());
      CHECK((start.face(a) == start.face(t) || e == 1));
    }
    m = start;
    if (const auto u = join_vertices(m, a)) {
      check_counts(m, -1, -1, 0);
      CHECK(*u == start.vertex(a));
      const HalfedgeId p = na == t ? nt : na, q = nt == a ? na : nt;
      const auto h = split_vertex(m, p, q);
      REQUIRE(h.has_value());
      CHECK(canonical(m) == canonical(start));
      if (nt != a && a.index % 2 == 0) {
        for (HalfedgeId x : all_halfedges(start)) {
          CHECK((m.next(x) == start.next(x) && m.prev(x) == start.prev(x) && m.vertex(x) == start.vertex(x) && m.face(x) == start.face(x)));
        }
      }
    } else {
      check_refusal(start, m, u.refusal());
      CHECK((start.vertex(a) == start.vertex(t) || e == 1));
    }
    m = start;
    if (const auto k = kill_segment(m, a)) {
      CHECK((e == 1 && m.vertex_count() == 0 && m.edge_count() == 0 && m.face_count() == 0));
      CHECK(faults(m) == "");
    } else {
      CHECK(k.refusal().code == Code::not_a_segment);
      check_refusal(start, m, k.refusal());
    }
  }
  return grown;
}

}  // namespace

TEST_CASE("make_segment makes the smallest shell, kill_segment removes it and the next one gets the same handles") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  CHECK((m.vertex_count() == 2 && m.edge_count() == 1 && m.face_count() == 1));
  CHECK((m.next(h) == twin(h) && m.next(twin(h)) == h && m.face(h) == m.face(twin(h))));
  CHECK(faults(m) == "");
  const auto before = records(m);
  REQUIRE(kill_segment(m, h));
  CHECK((m.vertex_count() == 0 && !m.alive(h) && !m.alive(twin(h)) && !m.alive(edge(h)) && !m.alive(VertexId{0})));
  CHECK(*make_segment(m) == h);
  CHECK(records(m) == before);
}

TEST_CASE("split_face then join_faces restores every record, anchors included") {
  auto m = shapes::build(shapes::cube_builder());
  const auto before = records(m);
  for (FaceId f : faces(m)) {
    for (HalfedgeId a : halfedges_of(m, f)) {
      auto copy = m;
      const HalfedgeId h = *split_face(copy, a, m.next(m.next(a)));
      CHECK(copy.data(copy.face(twin(h))).sheet == m.data(f).sheet);  // the new face has the data of its parent
      REQUIRE(join_faces(copy, h));
      CHECK(records(copy) == before);
    }
  }
}

TEST_CASE("each operator on every pair of half-edges of every planar map of up to four edges, and the maps are all reached") {
  // Sensed planar maps with n edges: 2, 4, 14, 57, 312 (OEIS A006384). Reaching exactly these shows that the operators miss no degenerate state
  // (spurs, loops, one-edge faces) and make no impossible one.
  Bare segment;
  REQUIRE(make_segment(segment));
  Bare loop;  // one vertex, one edge, two faces: join the ends of the second edge of a circle
  const HalfedgeId h = *make_segment(loop);
  REQUIRE(split_face(loop, h, twin(h)));
  REQUIRE(join_vertices(loop, h));
  CHECK((loop.vertex_count() == 1 && loop.edge_count() == 1 && loop.face_count() == 2));

  std::map<std::vector<std::uint32_t>, Bare> level{{canonical(segment), segment}, {canonical(loop), loop}};
  for (const std::size_t expected : {2u, 4u, 14u, 57u}) {
    CHECK(level.size() == expected);
    std::map<std::vector<std::uint32_t>, Bare> next;
    for (const auto& [word, mesh] : level) {
      for (Bare& grown : try_everything(mesh)) next.emplace(canonical(grown), std::move(grown));
    }
    level = std::move(next);
  }
  CHECK(level.size() == 312);
}

TEST_CASE("random sequences of all operators: always valid, v - e + f = 2(s - h), copies independent") {
  std::size_t states = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    HeavyMesh m;
    REQUIRE(make_segment(m));
    const std::size_t limit = 4 + random.below(60);
    for (int step = 0; step < 1000; ++step) {
      const auto all = all_halfedges(m);
      if (all.empty()) {
        REQUIRE(make_segment(m));
        continue;
      }
      const HalfedgeId a = all[random.below(all.size())];
      HalfedgeId same_face = a, same_vertex = a;
      for (std::uint32_t k = random.below(5); k > 0; --k) {
        same_face = m.next(same_face);
        same_vertex = m.next(twin(same_vertex));
      }
      const bool grow = m.edge_count() < limit ? random.below(3) != 0 : random.below(4) == 0;
      const auto before = records(m);
      bool done = false;
      switch (random.below(grow ? 10 : 6) + (grow ? 0 : 10)) {
        case 0:
          done = make_segment(m).has_value();
          break;
        case 1:
        case 2:
        case 3:
          done = split_face(m, a, same_face).has_value();
          break;
        case 4:
        case 5:
        case 6:
          done = split_vertex(m, a, same_vertex).has_value();
          break;
        case 7:
          done = split_face(m, a, all[random.below(all.size())]).has_value();
          break;
        case 8:
          done = split_vertex(m, a, all[random.below(all.size())]).has_value();
          break;
        case 9:
          done = split_edge(m, a).has_value();
          break;
        case 10:
        case 11:
          done = join_faces(m, a).has_value();
          break;
        case 12:
        case 13:
          done = join_vertices(m, a).has_value();
          break;
        default:
          done = kill_segment(m, a).has_value();
          break;
      }
      if (!done) {
        ++refused;
        REQUIRE(records(m) == before);
        continue;
      }
      ++states;
      REQUIRE(faults(m) == "");
      REQUIRE(genus(m) == 0);
      const auto v = static_cast<long>(m.vertex_count()), e = static_cast<long>(m.edge_count()), f = static_cast<long>(m.face_count());
      REQUIRE(v - e + f == 2 * static_cast<long>(shell_count(m)));
    }
    // Unwind: any such BRep comes down to nothing by joins alone.
    while (m.edge_count() > 0) {
      const HalfedgeId h = all_halfedges(m)[0];
      REQUIRE((join_faces(m, h) || kill_segment(m, h) || join_vertices(m, h) || split_edge(m, h)));
    }
    REQUIRE(faults(m) == "");
  }
  CHECK(states > 20000);
  CHECK(refused > 1000);
}

TEST_CASE("on a torus the operators keep the genus") {
  auto m = shapes::build<Bare>(shapes::torus_builder(3, 4));
  CHECK(genus(m) == 1);
  Random random(7);
  while (m.edge_count() > 2) {  // down to one vertex, two edges, one face
    const auto all = all_halfedges(m);
    const HalfedgeId h = all[random.below(all.size())];
    if (!(random.below(2) == 0 ? join_vertices(m, h).has_value() : join_faces(m, h).has_value())) continue;
    REQUIRE(faults(m) == "");
    REQUIRE(genus(m) == 1);
  }
  CHECK((m.vertex_count() == 1 && m.face_count() == 1));
  for (HalfedgeId h : all_halfedges(m)) {
    CHECK(join_faces(m, h).refusal().code == Code::same_face);
    CHECK(join_vertices(m, h).refusal().code == Code::same_vertex);
    CHECK(kill_segment(m, h).refusal().code == Code::not_a_segment);
  }
}

TEST_CASE("dead and invalid handles are refused by every operator, with a sentence that names them") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  const HalfedgeId n = *split_edge(m, h);
  REQUIRE(join_vertices(m, twin(n)));
  const auto before = records(m);
  for (HalfedgeId bad : {n, HalfedgeId{}, HalfedgeId{100}}) {
    CHECK(split_face(m, bad, h).refusal().code == Code::dead);
    CHECK(split_face(m, h, bad).refusal().code == Code::dead);
    CHECK(split_vertex(m, bad, h).refusal().code == Code::dead);
    CHECK(split_vertex(m, h, bad).refusal().code == Code::dead);
    CHECK(split_edge(m, bad).refusal().code == Code::dead);
    CHECK(join_faces(m, bad).refusal().code == Code::dead);
    CHECK(join_vertices(m, bad).refusal().code == Code::dead);
    CHECK(kill_segment(m, bad).refusal().code == Code::dead);
  }
  CHECK(split_edge(m, n).refusal().sentence().find(to_string(n)) == 0);
  CHECK(records(m) == before);
}

TEST_CASE("new half-edges and vertices have default data, a new face a copy of its parent's") {
  struct Numbered {
    int number = -1;
  };
  BRep<Numbered, Numbered, Numbered> m;
  HalfedgeId h = *make_segment(m);
  m.data(h).number = 1;
  m.data(m.face(h)).number = 5;
  const HalfedgeId n = *split_edge(m, h);
  CHECK(m.data(h).number == 1);
  CHECK((m.data(n).number == -1 && m.data(twin(n)).number == -1 && m.data(m.vertex(n)).number == -1));
  const HalfedgeId cut = *split_face(m, h, n);
  CHECK(m.data(m.face(twin(cut))).number == 5);
  m.data(cut).number = 9;
  REQUIRE(join_faces(m, cut));
  const HalfedgeId again = *split_vertex(m, h, h);  // gets the slot of the killed edge
  CHECK(again == cut);
  CHECK(m.data(again).number == -1);
}

TEST_CASE("first_side_is_shorter tells which side split_face(a, b) would relabel") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  for (int i = 0; i < 20; ++i) REQUIRE(split_edge(m, h));
  for (HalfedgeId a : all_halfedges(m)) {
    std::size_t way = 0;
    const std::size_t n = degree(m, m.face(a));
    for (HalfedgeId b = a; way < n; b = m.next(b), ++way) CHECK(first_side_is_shorter(m, a, b) == (2 * way <= n));
  }
}
