// SPDX-License-Identifier: MIT
// The log: undo, redo and replay restore every record and datum, over random sequences of all operators, handles and several shells
// included. (A million states without data: random_test.cpp.)

#include <brep/euler_log.hpp>
#include <brep/replay.hpp>

#include "calls.hpp"

using namespace brep;

namespace {

struct NumberData {
  int number = 0;
};
struct ListData {
  std::vector<int> list;
};
using DataLogged = BRep<NumberData, ListData, ListData, EulerLog>;

// The picture of all records and the data of all living elements.
std::vector<std::uint32_t> everything(const DataLogged& m) {
  std::vector<std::uint32_t> all = shapes::picture(m);
  const auto add = [&](const ListData& data) {
    for (int x : data.list) { all.push_back(static_cast<std::uint32_t>(x)); }
  };
  for (HalfedgeId h : shapes::all_halfedges(m)) { add(m.data(h)); }
  for (FaceId f : faces(m)) { add(m.data(f)); }
  for (VertexId v : vertices(m)) { all.push_back(static_cast<std::uint32_t>(m.data(v).number)); }
  return all;
}

// Elements that have just been made with default data get some of their own. (The log does not see what is written into data, so
// nothing is written into older ones.)
void write_new_data(DataLogged& m, int& number) {
  for (HalfedgeId h : shapes::all_halfedges(m)) {
    if (m.data(h).list.empty()) { m.data(h).list = {++number, number}; }
  }
  for (FaceId f : faces(m)) {
    if (m.data(f).list.empty()) { m.data(f).list = {++number}; }
  }
  for (VertexId v : vertices(m)) {
    if (m.data(v).number == 0) { m.data(v).number = ++number; }
  }
}

}  // namespace

TEST_CASE("undo and redo restore every record, free list and datum, replay makes the same BRep") {
  std::size_t most_handles = 0, most_shells = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    DataLogged m;
    std::vector<std::vector<std::uint32_t>> states{everything(m)};
    const std::size_t limit = 4 + random.below(40);
    int number = 0;
    while (states.size() < 250) {
      const calls::Answer answer = calls::apply(m, calls::random_call(m, random, limit));
      if (!answer.done) {
        REQUIRE(everything(m) == states.back());
        continue;
      }
      write_new_data(m, number);
      REQUIRE(shapes::faults(m) == "");
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
    const DataLogged end = m;
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
    DataLogged other;
    const Replay replayed = replay(steps(end), other);
    INFO(replayed.refusal.sentence());
    REQUIRE(replayed.done == states.size() - 1);
    CHECK(shapes::picture(other) == shapes::picture(end));
  }
  CHECK(most_handles > 3);
  CHECK(most_shells > 3);
}

TEST_CASE("a new operator ends what could be redone, and undo_to a mark that never was redoes all") {
  BRep<NoData, NoData, NoData, EulerLog> m;
  const HalfedgeId h = *make_segment(m);
  const std::size_t segment = mark(m);
  REQUIRE(split_edge(m, h));
  REQUIRE(split_edge(m, h));
  const auto end = shapes::picture(m);
  REQUIRE(undo_to(m, segment));
  CHECK_FALSE(undo_to(m, 100));
  CHECK((mark(m) == 3 && shapes::picture(m) == end));
  REQUIRE(undo(m));
  REQUIRE(split_face(m, h, h));
  CHECK_FALSE(redo(m));
  CHECK(mark(m) == 3);
  CHECK_FALSE(split_face(m, h, HalfedgeId{90}).has_value());
  CHECK(mark(m) == 3);  // a refusal is no step
}

TEST_CASE("replay stops where the other BRep is not as the first was, and says why") {
  BRep<NoData, NoData, NoData, EulerLog> m;
  const HalfedgeId h = *make_segment(m);
  REQUIRE(split_face(m, h, h));
  BRep<> other;
  REQUIRE(make_segment(other));
  const Replay occupied = replay(steps(m), other);
  CHECK((occupied.done == 0 && occupied.refusal.code == Code::other_handle));
  BRep<> empty;
  const Replay second_only = replay(steps(m).subspan(1), empty);
  CHECK((second_only.done == 0 && second_only.refusal.code == Code::dead && empty.edge_count() == 0));
  CHECK_FALSE(second_only.refusal.sentence().empty());
  CHECK(replay(steps(m), empty));
  CHECK(shapes::picture(empty) == shapes::picture(m));
}
