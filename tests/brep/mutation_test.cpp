// SPDX-License-Identifier: MIT
// Mutation test of the validator: one field of one record is overwritten; an independent slow check says whether that is a fault, and the
// validator must agree and name the right rule. The catch rate of each field is printed.
//
// Harmless by nature, and no faults: an anchor moved to another half-edge of the same face or vertex; whatever stands in
// a dead slot beside its link, where records keep what they held when they were killed. Any other change of a
// structural field is a fault: next, prev, vertex and face of a half-edge are settled by the others.

#include <brep/validate.hpp>

#include <array>
#include <cstdio>
#include <set>

#include "calls.hpp"
#include "slow_check.hpp"

using namespace brep;
using detail::Raw;
using shapes::Random;

namespace {

using Bare = BRep<>;

// The private counter and list head of a pool: an explicit instantiation may name a private member.
using HalfedgePool = Pool<detail::HalfedgeRecord, NoData, 2>;
using ElementPool = Pool<detail::AnchorRecord, NoData>;
template <class Tag, typename Tag::type Pointer>
struct Open {
  friend typename Tag::type member(Tag) { return Pointer; }
};
struct HalfedgeCount {
  using type = std::uint32_t HalfedgePool::*;
  friend type member(HalfedgeCount);
};
struct HalfedgeHead {
  using type = std::uint32_t HalfedgePool::*;
  friend type member(HalfedgeHead);
};
struct ElementCount {
  using type = std::uint32_t ElementPool::*;
  friend type member(ElementCount);
};
struct ElementHead {
  using type = std::uint32_t ElementPool::*;
  friend type member(ElementHead);
};
template struct Open<HalfedgeCount, &HalfedgePool::count_>;
template struct Open<HalfedgeHead, &HalfedgePool::free_>;
template struct Open<ElementCount, &ElementPool::count_>;
template struct Open<ElementHead, &ElementPool::free_>;

std::uint32_t& counter(HalfedgePool& pool) { return pool.*member(HalfedgeCount{}); }
std::uint32_t& counter(ElementPool& pool) { return pool.*member(ElementCount{}); }
std::uint32_t& list_head(HalfedgePool& pool) { return pool.*member(HalfedgeHead{}); }
std::uint32_t& list_head(ElementPool& pool) { return pool.*member(ElementHead{}); }

enum Mutation { next, prev, vertex, face, vertex_anchor, face_anchor, free_link, free_head, count, stale, fields };
constexpr std::array<const char*, fields> mutation_names{"next",        "prev",      "vertex",    "face",    "vertex anchor",
                                                         "face anchor", "free link", "free head", "counter", "rest of a dead slot"};
constexpr std::uint32_t dead_bit = HalfedgePool::dead_bit;

// A living or dead element, the first beyond the end, a flipped bit, or any number.
std::uint32_t new_value(std::uint32_t old, std::uint32_t end, Random& random) {
  switch (random.below(8)) {
    case 0:
      return end + random.below(3);
    case 1:
      return old ^ (1u << random.below(32));
    case 2:
      return random.below(0xffffffff);
    default:
      return random.below(end);
  }
}

template <class Alive>
std::uint32_t slot(std::uint32_t end, std::uint32_t step, bool alive, Alive&& is_alive, Random& random) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const std::uint32_t i = random.below(end) / step * step;
    if (is_alive(i) == alive) { return i; }
  }
  return invalid_index;
}

// Overwrites one field; the rule that must be named, 0 where the change is none or harmless by nature.
int mutate(Bare& m, Mutation field, Random& random) {
  const Bare before = m;
  auto& halfedges = Raw::halfedges(m);
  const auto live = [&](auto& pool, std::uint32_t step) {
    return slot(
        pool.size(), step, true, [&](std::uint32_t i) { return pool.alive(i); }, random);
  };
  const auto dead = [&](auto& pool, std::uint32_t step) {
    return slot(
        pool.size(), step, false, [&](std::uint32_t i) { return pool.alive(i); }, random);
  };
  const auto write = [&](std::uint32_t& word, std::uint32_t end) {
    const std::uint32_t old = word;
    word = new_value(old, end, random);
    return word != old;
  };
  const HalfedgeId h{live(halfedges, 2) + random.below(2)};
  auto& r = halfedges[h.index];
  switch (field) {
    case next:
      if (!write(r.next.index, halfedges.size())) { return 0; }
      if (h.index % 2 == 0 && (r.next.index & dead_bit) != 0) return 7;  // the edge looks dead
      return before.alive(r.next) ? 3 : 1;
    case prev:
      if (!write(r.prev.index, halfedges.size())) { return 0; }
      return before.alive(r.prev) ? 3 : 1;
    case vertex:
      if (!write(r.vertex.index, m.vertex_end())) { return 0; }
      if (!before.alive(r.vertex)) { return 1; }
      return degree(before, before.vertex(h)) == 1 ? 6 : 2;  // the end of a spur has no neighbour that could disagree
    case face:
      if (!write(r.face.index, m.face_end())) { return 0; }
      if (!before.alive(r.face)) { return 1; }
      return before.halfedge(before.face(h)) == h ? 6 : 4;
    case vertex_anchor: {
      const VertexId v{live(Raw::vertices(m), 1)};
      HalfedgeId& anchor = Raw::at(m, v).halfedge;
      if (!write(anchor.index, halfedges.size())) { return 0; }
      if ((anchor.index & dead_bit) != 0) { return 7; }
      if (!before.alive(anchor)) { return 1; }
      return before.vertex(anchor) == v ? 0 : 6;
    }
    case face_anchor: {
      const FaceId f{live(Raw::faces(m), 1)};
      HalfedgeId& anchor = Raw::at(m, f).halfedge;
      if (!write(anchor.index, halfedges.size())) { return 0; }
      if ((anchor.index & dead_bit) != 0) { return 7; }
      if (!before.alive(anchor)) { return 1; }
      return before.face(anchor) == f ? 0 : 6;
    }
    case free_link:
    case free_head:
    case count: {
      const auto damage = [&](auto& pool, std::uint32_t step) {
        if (field == count) { return write(counter(pool), pool.size()) ? 8 : 0; }
        if (field == free_head) { return write(list_head(pool), pool.size()) ? 7 : 0; }
        const std::uint32_t i = dead(pool, step);
        if (i == invalid_index) { return 0; }
        std::uint32_t& word = link(pool[i]);
        const std::uint32_t old = word;
        word = new_value(old & ~dead_bit, pool.size(), random) ^ (random.below(8) == 0 ? 0 : dead_bit);
        return word != old ? 7 : 0;
      };
      switch (random.below(3)) {
        case 0:
          return damage(halfedges, 2);
        case 1:
          return damage(Raw::vertices(m), 1);
        default:
          return damage(Raw::faces(m), 1);
      }
    }
    default: {
      const std::uint32_t i = dead(halfedges, 2);
      if (i == invalid_index) { return 0; }
      auto& t = halfedges[i + 1];
      for (std::uint32_t* word : {&halfedges[i].prev.index, &halfedges[i].vertex.index, &halfedges[i].face.index, &t.next.index,
                                  &t.prev.index, &t.vertex.index, &t.face.index}) {
        if (random.below(3) == 0) { *word = new_value(*word, halfedges.size(), random); }
      }
      return 0;
    }
  }
}

// Some shells with handles, loops and spurs, and some dead slots of each kind.
Bare sample(Random& random) {
  Bare m;
  const std::size_t limit = 2 + random.below(30);
  for (int i = 0; i < 150 || m.edge_count() == 0; ++i) { calls::apply(m, calls::random_call(m, random, limit)); }
  return m;
}

std::set<int> rules_of(const std::vector<Fault>& faults) {
  std::set<int> found;
  for (const Fault& fault : faults) {
    CHECK(fault.sentence.substr(0, 4) == std::string{'R', static_cast<char>('0' + fault.rule), ':', ' '});
    found.insert(fault.rule);
  }
  return found;
}

}  // namespace

TEST_CASE("one field of one record is overwritten: every fault is caught, with the right rule") {
  struct Score {
    int faults = 0, caught = 0, right = 0, harmless = 0;
  };
  std::array<Score, fields> scores{};
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Bare sound = sample(random);
    REQUIRE(slow_check::is_sound(sound));
    REQUIRE(shapes::faults(sound) == "");
    for (int round = 0; round < 5 * fields; ++round) {
      const auto field = static_cast<Mutation>(round % fields);
      INFO("round " << round << ", field " << mutation_names[field]);
      Bare m = sound;
      const int rule = mutate(m, field, random);
      const std::vector<Fault> found = validate(m);
      const bool is_sound = slow_check::is_sound(m);
      CHECK(is_sound == (rule == 0));
      CHECK(is_valid(m) == is_sound);
      CHECK(found.empty() == is_sound);
      Score& score = scores[field];
      score.harmless += is_sound;
      if (is_sound) { continue; }
      ++score.faults;
      score.caught += !found.empty();
      const bool right = rules_of(found).count(rule) != 0;
      score.right += right;
      if (!right) {
        INFO("expected R" << rule << ", found:\n" << shapes::faults(m));
        CHECK(right);
      }
    }
  }
  std::printf("mutations of one field: %8s %8s %10s %9s\n", "faults", "caught", "right rule", "harmless");
  for (int i = 0; i < fields; ++i) {
    const Score& score = scores[static_cast<std::size_t>(i)];
    std::printf("%23s %8d %7.1f%% %9.1f%% %9d\n", mutation_names[static_cast<std::size_t>(i)], score.faults,
                score.faults == 0 ? 100.0 : 100.0 * score.caught / score.faults,
                score.faults == 0 ? 100.0 : 100.0 * score.right / score.faults, score.harmless);
    CHECK(score.caught == score.faults);
    CHECK((i == stale ? score.faults == 0 : score.faults > 1000));
  }
}

TEST_CASE("many words overwritten at once: the validator agrees with the slow check and never loses its way") {
  int sound = 0;
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Bare m = sample(random);
    for (std::uint32_t k = 1 + random.below(seed % 3 == 0 ? 40 : 3); k > 0; --k) {
      auto& r = Raw::halfedges(m)[random.below(m.halfedge_end())];  // dead ones, too
      const std::array<std::uint32_t*, 8> words{&r.next.index,
                                                &r.prev.index,
                                                &r.vertex.index,
                                                &r.face.index,
                                                &Raw::vertices(m)[random.below(m.vertex_end())].halfedge.index,
                                                &Raw::faces(m)[random.below(m.face_end())].halfedge.index,
                                                &list_head(Raw::halfedges(m)),
                                                &counter(Raw::faces(m))};
      std::uint32_t& word = *words[random.below(8)];
      word = new_value(word, m.halfedge_end(), random);
    }
    const bool is_sound = slow_check::is_sound(m);
    sound += is_sound;
    CHECK(is_valid(m) == is_sound);
    CHECK(validate(m).empty() == is_sound);
  }
  CHECK(sound > 20);
  CHECK(sound < 1500);
}
