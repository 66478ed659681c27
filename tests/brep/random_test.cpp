// SPDX-License-Identifier: MIT
// Long random sequences of all operators. After each step every law is asked for; a sequence that breaks one is made as short as it can be
// and printed.

#include <brep/euler_log.hpp>
#include <brep/replay.hpp>

#include <optional>

#include "calls.hpp"

using namespace brep;
using calls::Call;
using shapes::picture;
using shapes::Random;

namespace {

using Logged = BRep<NoData, NoData, NoData, EulerLog>;

constexpr std::size_t states_a_seed = 1100;

struct Tally {
  std::size_t states = 0, refused = 0, most_shells = 0;
  long most_handles = 0;
};

// Which (s, h) may follow.
bool shells_follow(Operator op, const calls::Shells& before, const calls::Shells& after) {
  const long ds = static_cast<long>(after.count) - static_cast<long>(before.count), dh = after.handles - before.handles;
  switch (op) {
    case Operator::make_segment:
      return ds == 1 && dh == 0;
    case Operator::kill_segment:
      return ds == -1 && dh == 0;
    case Operator::bridge:
    case Operator::weld:
      return (ds == -1 && dh == 0) || (ds == 0 && dh == 1);
    case Operator::cut:
    case Operator::unweld:
      return (ds == 1 && dh == 0) || (ds == 0 && dh == -1);
    default:
      return ds == 0 && dh == 0;
  }
}

// A BRep under observation: the pictures and shells of its present state are at hand.
struct Subject {
  Logged m;
  std::vector<std::uint32_t> now = picture(m);
  calls::Shells shells{};

  // Applies the call; the law that does not hold, empty when all do.
  std::string step(const Call& call, Tally& statistics) {
    const auto before = now;
    const calls::Shells shells_before = shells;
    const long v = static_cast<long>(m.vertex_count()), e = static_cast<long>(m.edge_count()), f = static_cast<long>(m.face_count());
    const Code promised = calls::promised(m, call);
    const calls::Answer answer = calls::apply(m, call);
    if (answer.refusal.code != promised) { return "the refusal is not the promised one: " + answer.refusal.sentence(); }
    now = picture(m);
    if (!answer.done) {
      ++statistics.refused;
      return now == before ? "" : "a refused call changed a record";
    }
    ++statistics.states;
    if (!is_valid(m)) { return shapes::faults(m); }
    const calls::Change change = calls::change(call.op);
    if (static_cast<long>(m.vertex_count()) != v + change.v || static_cast<long>(m.edge_count()) != e + change.e ||
        static_cast<long>(m.face_count()) != f + change.f) {
      return "the counts are not those of the operator";
    }
    shells = calls::shells(m);
    if (!shells.closed) { return "v - e + f = 2 - 2h fails in a shell"; }
    if (!shells_follow(call.op, shells_before, shells)) { return "shells and handles are not those of the operator"; }
    statistics.most_shells = std::max(statistics.most_shells, shells.count);
    statistics.most_handles = std::max(statistics.most_handles, shells.handles);

    if (!undo(m) || picture(m) != before) { return "undo does not restore every record"; }
    const Call back = calls::inverse(m, call, answer.made);
    const calls::Restores restores = calls::restores(m, call);
    const auto without_anchors = picture(m, shapes::Anchors::hidden);
    if (!redo(m) || picture(m) != now) { return "redo does not restore every record"; }
    if (!calls::apply(m, back).done) { return "the inverse is refused: " + calls::to_string(back); }
    if (restores == calls::Restores::every_record && picture(m) != before) { return "the inverse does not restore every record"; }
    if (restores != calls::Restores::the_shape && picture(m, shapes::Anchors::hidden) != without_anchors) {
      return "the inverse does not restore every record but anchors";
    }
    if (!is_valid(m)) { return "after the inverse: " + shapes::faults(m); }
    if (!undo(m) || picture(m) != now) { return "undo of the inverse does not restore every record"; }
    return {};
  }
};

std::string play(std::span<const Call> list) {
  Subject subject;
  Tally unused;
  for (const Call& call : list) {
    if (std::string broken = subject.step(call, unused); !broken.empty()) { return broken; }
  }
  return {};
}

// All of one seed; the first law that is broken, with the shortest sequence found that breaks one.
std::string run(std::uint32_t seed, Tally& statistics) {
  Random random(seed);
  Subject subject;
  Logged& m = subject.m;
  const auto start = subject.now;
  std::vector<Call> list;
  const std::size_t limit = 3 + random.below(seed % 10 == 0 ? 200 : 40);
  for (const std::size_t end = statistics.states + states_a_seed; statistics.states < end;) {
    list.push_back(calls::random_call(m, random, limit));
    if (!subject.step(list.back(), statistics).empty()) {
      const auto shortest = calls::shrink(list, [](std::span<const Call> shorter) { return !play(shorter).empty(); });
      return play(shortest) + "\nafter\n" + calls::to_string(shortest);
    }
  }
  const Logged end = m;
  if (!undo_to(m, 0) || picture(m) != start) { return "the whole log undone is not the start"; }
  if (!undo_to(m, mark(end)) || picture(m) != subject.now) { return "the whole log redone is not the end"; }
  Logged other;
  const Replay replayed = replay(steps(end), other);
  if (!replayed) { return "replay: " + replayed.refusal.sentence(); }
  if (picture(other) != subject.now) { return "replay into an empty BRep gives other records"; }
  return {};
}

void run_seeds(std::uint32_t first, std::uint32_t last) {
  Tally statistics;
  for (std::uint32_t seed = first; seed <= last; ++seed) {
    if (const std::string broken = run(seed, statistics); !broken.empty()) { FAIL("seed " << seed << ": " << broken); }
  }
  CHECK(statistics.states >= (last - first + 1) * states_a_seed);
  CHECK(statistics.refused > statistics.states / 20);
  CHECK(statistics.most_handles >= 5);
  CHECK(statistics.most_shells >= 5);
  std::printf("random sequences: %zu states, %zu refusals, up to %ld handles and %zu shells\n", statistics.states, statistics.refused,
              statistics.most_handles, statistics.most_shells);
}

}  // namespace

TEST_CASE("random states: valid, v - e + f = 2(s - h), inverse, undo, redo and replay restore every record") { run_seeds(1, 40); }
TEST_CASE("a million random states, other seeds", "[slow]") { run_seeds(41, 1040); }

TEST_CASE("a failing sequence is shrunk until no step can be spared") {
  // Played with a law that does not hold: "no shell has two handles". Such a shell has e = v + f + 2 >= 4, so it takes four steps at least.
  const auto two_handles = [](std::span<const Call> list) {
    Logged m;
    for (const Call& call : list) {
      calls::apply(m, call);
      if (genus(m) == 2) { return true; }
    }
    return false;
  };
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Logged m;
    std::vector<Call> list;
    while (!two_handles(list)) {
      for (int i = 0; i < 50; ++i) {
        list.push_back(calls::random_call(m, random, 30));
        calls::apply(m, list.back());
      }
    }
    const auto shortest = calls::shrink(list, two_handles);
    INFO(calls::to_string(shortest));
    CHECK(two_handles(shortest));
    for (std::size_t i = 0; i < shortest.size(); ++i) {
      auto shorter = shortest;
      shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
      CHECK_FALSE(two_handles(shorter));
    }
    CHECK(shortest.size() < 20);
    CHECK(shortest.size() >= 4);
  }
}
