// SPDX-License-Identifier: MIT
// The log: undo, redo and replay restore every record, over random sequences of all operators, handles and several shells included.

#include <brep/euler_log.hpp>
#include <brep/replay.hpp>

#include "shapes.hpp"

using namespace brep;

namespace {

struct Numbered {
  int number = 0;
};
struct Listed {
  std::vector<int> list;
};
using Logged = BRep<Numbered, Listed, Listed, EulerLog>;

// Every record and datum of every living element, the counts, and the next 300 slots that each pool will give out. (Slots that were used
// for the first time since are free after an undo, and are given out in the order in which fresh ones would be.)
std::vector<std::uint32_t> everything(const Logged& m) {
  using detail::Raw;
  std::vector<std::uint32_t> all;
  for (EdgeId e : edges(m)) {
    for (HalfedgeId h : {halfedge(e), twin(halfedge(e))}) {
      const auto& r = Raw::at(m, h);
      all.insert(all.end(), {h.index, r.next.index, r.prev.index, r.vertex.index, r.face.index});
      for (int x : m.data(h).list) all.push_back(static_cast<std::uint32_t>(x));
    }
  }
  for (VertexId v : vertices(m)) all.insert(all.end(), {v.index, m.halfedge(v).index, static_cast<std::uint32_t>(m.data(v).number)});
  for (FaceId f : faces(m)) {
    all.insert(all.end(), {f.index, m.halfedge(f).index});
    for (int x : m.data(f).list) all.push_back(static_cast<std::uint32_t>(x));
  }
  const auto pool = [&](const auto& p, std::uint32_t group) {
    all.push_back(p.count());
    std::uint32_t i = p.first_free(), fresh = p.size();
    for (int k = 0; k < 300; ++k) {
      all.push_back(i != p.end_of_list ? i : fresh);
      if (i != p.end_of_list)
        i = link(p[i]) & ~p.dead_bit;
      else
        fresh += group;
    }
  };
  pool(Raw::halfedges(m), 2);
  pool(Raw::vertices(m), 1);
  pool(Raw::faces(m), 1);
  return all;
}

template <class B>
bool random_operator(B& m, shapes::Random& random, std::size_t limit) {
  const auto all = shapes::all_halfedges(m);
  if (all.empty()) return make_segment(m).has_value();
  const auto any = [&] { return all[random.below(all.size())]; };
  const HalfedgeId a = any();
  HalfedgeId around_face = a, around_vertex = a;
  for (std::uint32_t k = random.below(5); k > 0; --k) {
    around_face = m.next(around_face);
    around_vertex = m.next(twin(around_vertex));
  }
  if (m.edge_count() < limit && random.below(3) != 0) {
    switch (random.below(8)) {
      case 0:
        return make_segment(m).has_value();
      case 1:
        return bridge(m, a, any()).has_value();
      case 2:
        return weld(m, a, any()).has_value();
      case 3:
        return split_edge(m, a).has_value();
      case 4:
      case 5:
        return split_face(m, a, around_face).has_value();
      default:
        return split_vertex(m, a, around_vertex).has_value();
    }
  }
  switch (random.below(6)) {
    case 0:
      return join_faces(m, a).has_value();
    case 1:
      return join_vertices(m, a).has_value();
    case 2:
      return cut(m, a).has_value();
    case 3:
      return unweld(m, a).has_value();
    case 4:
      m.set_anchor(m.face(a), a);
      return true;
    default:
      return kill_segment(m, a).has_value();
  }
}

}  // namespace

TEST_CASE("undo and redo restore every record, free list and datum; replay makes the same BRep") {
  std::size_t most_handles = 0, most_shells = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Logged m;
    std::vector<std::vector<std::uint32_t>> states{everything(m)};
    const std::size_t limit = 4 + random.below(40);
    while (states.size() < 250) {
      if (!random_operator(m, random, limit)) {
        REQUIRE(everything(m) == states.back());
        continue;
      }
      REQUIRE(shapes::faults(m) == "");
      REQUIRE(genus(m) >= 0);
      most_handles = std::max(most_handles, static_cast<std::size_t>(genus(m)));
      most_shells = std::max(most_shells, shell_count(m));
      states.push_back(everything(m));
      REQUIRE(mark(m) == states.size() - 1);
      if (random.below(8) == 0) {  // a jump back and forth
        const std::size_t back = random.below(states.size());
        REQUIRE(undo_to(m, back));
        REQUIRE(everything(m) == states[back]);
        REQUIRE(undo_to(m, states.size() - 1));
        REQUIRE(everything(m) == states.back());
      }
    }
    const Logged end = m;
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      REQUIRE(undo(m));
      REQUIRE(everything(m) == states[i]);
      REQUIRE(shapes::faults(m) == "");
    }
    CHECK_FALSE(undo(m));
    for (std::size_t i = 1; i < states.size(); ++i) {
      REQUIRE(redo(m));
      REQUIRE(everything(m) == states[i]);
    }
    CHECK_FALSE(redo(m));
    Logged other;
    const Replay replayed = replay(steps(end), other);
    INFO(replayed.refusal.sentence());
    REQUIRE(replayed.done == states.size() - 1);
    CHECK(shapes::records(other) == shapes::records(end));
  }
  CHECK(most_handles > 3);
  CHECK(most_shells > 3);
}
