// SPDX-License-Identifier: MIT
#pragma once

// Is this BRep what brep.hpp promises? All faults at once, each with its rule, the elements and a sentence.
//
//   R1  every handle in a record names a living element
//   R2  next(h) starts where h ends
//   R3  next and prev are inverse
//   R4  the loop of a face is exactly the half-edges that name the face
//   R5  the half-edges around a vertex are exactly those that name the vertex
//   R6  the anchor of a face lies on it, the anchor of a vertex leaves it
//   R7  the free lists hold exactly the dead slots
//   R8  the counts are right, and v - e + f = 2(s - h) with h >= 0
//
// These are the rules of structure. Loops, spurs and faces of one edge obey them; what an algorithm may want beyond (at
// least three edges, planarity) is not a matter of validity. A BRep that keeps R1 to R5 has v - e + f = 2 - 2h in each
// connected shell by Euler's theorem; what is left of R8 is that the counters say so (shell_count and genus give s and h).
//
// Linear time and memory, also on damaged records: no walk follows a handle before R1 was checked, none visits a half-edge twice.
// A sound BRep takes some 15 ns a half-edge; sentences are made only for faults.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>

namespace brep {

struct Fault {
  int rule;                       // 1 to 8
  std::vector<Element> elements;  // in the order in which the sentence names them
  std::string sentence;           // begins with the rule: "R5: ..."
};

namespace detail {

template <class B>
class Validation {
 public:
  explicit Validation(const B& brep) : brep_(brep) {}

  std::vector<Fault> run() {
    check_free_list(Raw::halfedges(brep_), 2, [](std::uint32_t i) { return Element(edge(HalfedgeId{i})); });
    check_free_list(Raw::vertices(brep_), 1, [](std::uint32_t i) { return Element(VertexId{i}); });
    check_free_list(Raw::faces(brep_), 1, [](std::uint32_t i) { return Element(FaceId{i}); });
    check_handles();
    const bool can_walk = faults_.empty() || !has_rule(1);
    if (can_walk) {
      check_steps();
      if (!loops_are_closed_ || !count_matches(true)) explain_loops();
      if (!orbits_are_closed_ || !count_matches(false)) explain_orbits();
    }
    if (faults_.empty()) check_euler();
    return std::move(faults_);
  }

 private:
  void add(int rule, std::vector<Element> elements, const std::string& text) {
    std::string sentence = "R";
    sentence += std::to_string(rule);
    faults_.push_back({rule, std::move(elements), sentence + ": " + text});
  }
  [[nodiscard]] bool has_rule(int rule) const {
    for (const Fault& fault : faults_) {
      if (fault.rule == rule) return true;
    }
    return false;
  }
  template <class Visit>
  void each_halfedge(Visit&& visit) const {
    for (std::uint32_t i = 0; i < brep_.halfedge_end(); ++i) {
      if (brep_.alive(HalfedgeId{i})) visit(HalfedgeId{i});
    }
  }

  template <class PoolType, class Name>
  void check_free_list(const PoolType& pool, std::uint32_t step, Name&& name) {
    std::vector<bool> listed(pool.size(), false);
    Element before;
    for (std::uint32_t i = pool.first_free(); i != PoolType::end_of_list; i = link(pool[i]) & ~PoolType::dead_bit) {
      const Element here = i < pool.size() ? name(i) : Element{};
      const auto place = [&] {
        return before.letter == 0 ? std::string("the free list begins with ") : "the free list goes from " + to_string(before) + " to ";
      };
      if (i >= pool.size() || i % step != 0) {
        add(7, {before}, place() + "a slot that does not exist; the records were overwritten");
        break;
      }
      if (pool.alive(i)) {
        add(7, {here, before}, place() + to_string(here) + ", which is alive");
        break;
      }
      if (listed[i]) {
        add(7, {here, before}, place() + to_string(here) + " for the second time; it was killed twice");
        break;
      }
      listed[i] = true;
      before = here;
    }
    std::uint32_t live = 0;
    for (std::uint32_t i = 0; i < pool.size(); i += step) {
      if (pool.alive(i))
        ++live;
      else if (!listed[i])
        add(7, {name(i)}, to_string(name(i)) + " is dead but not in the free list: its handle can never be used again");
    }
    if (live != pool.count()) {
      add(8, {}, std::to_string(live) + " slots of a pool are alive, but " + std::to_string(pool.count()) + " are counted");
    }
  }

  template <char Letter>
  void check_handle(Element owner, const char* field, Id<Letter> id) {
    if (brep_.alive(id)) return;
    add(1, {owner, id},
        to_string(owner) + " has the " + field + " " + to_string(id) + ", which is not alive; usually a handle kept over a kill");
  }
  void check_handles() {
    each_halfedge([&](HalfedgeId h) {
      const HalfedgeRecord& r = Raw::at(brep_, h);
      if (brep_.alive(r.next) && brep_.alive(r.prev) && brep_.alive(r.vertex) && brep_.alive(r.face)) return;
      check_handle(h, "next", r.next);
      check_handle(h, "prev", r.prev);
      check_handle(h, "vertex", r.vertex);
      check_handle(h, "face", r.face);
    });
    for (FaceId f : faces(brep_)) check_handle(f, "anchor", brep_.halfedge(f));
    for (VertexId v : vertices(brep_)) check_handle(v, "anchor", brep_.halfedge(v));
  }

  // What can be seen at one half-edge. When next is a permutation and all steps agree, every loop has one face and every
  // orbit one vertex; then counting tells whether a face or vertex has more than one.
  void check_steps() {
    each_halfedge([&](HalfedgeId h) {
      const HalfedgeRecord& r = Raw::at(brep_, h);
      const HalfedgeRecord& after = Raw::at(brep_, r.next);
      if (after.prev != h) {
        loops_are_closed_ = orbits_are_closed_ = false;
        add(3, {h, r.next, after.prev},
            "next(" + to_string(h) + ") is " + to_string(r.next) + ", but prev(" + to_string(r.next) + ") is " + to_string(after.prev) +
                "; one of the two links was not set");
      }
      const HalfedgeId back = Raw::at(brep_, r.prev).next;
      if (back != h) {
        loops_are_closed_ = orbits_are_closed_ = false;
        add(3, {h, r.prev, back},
            "prev(" + to_string(h) + ") is " + to_string(r.prev) + ", but next(" + to_string(r.prev) + ") is " + to_string(back) +
                "; one of the two links was not set");
      }
      const VertexId end = Raw::at(brep_, twin(h)).vertex;
      if (after.vertex != end) {
        orbits_are_closed_ = false;
        add(2, {h, end, r.next, after.vertex},
            to_string(h) + " ends at " + to_string(end) + ", but its next, " + to_string(r.next) + ", starts at " +
                to_string(after.vertex));
      }
      if (after.face != r.face) loops_are_closed_ = false;
    });
  }

  // Do the walks from all anchors together meet every half-edge? They are disjoint, since steps agree.
  [[nodiscard]] bool count_matches(bool around_faces) const {
    std::size_t sum = 0;
    const std::size_t all = 2 * brep_.edge_count();
    const auto walk = [&](auto id, auto owner, auto step) {
      const HalfedgeId first = brep_.halfedge(id);
      if (owner(first) != id) return false;
      HalfedgeId h = first;
      do { h = step(h); } while (++sum <= all && h != first);
      return sum <= all;
    };
    if (around_faces) {
      for (FaceId f : faces(brep_)) {
        if (!walk(
                f, [&](HalfedgeId h) { return brep_.face(h); }, [&](HalfedgeId h) { return brep_.next(h); }))
          return false;
      }
    } else {
      for (VertexId v : vertices(brep_)) {
        if (!walk(
                v, [&](HalfedgeId h) { return brep_.vertex(h); }, [&](HalfedgeId h) { return brep_.next(twin(h)); }))
          return false;
      }
    }
    return sum == all;
  }

  // The slow pass: marks the walk from each anchor, then looks at every half-edge that was not met.
  template <class IdType, class Range, class Owner, class Step>
  void explain(Range&& range, Owner&& owner, Step&& step, int rule, const char* walk, const char* cause) {
    std::vector<bool> seen(brep_.halfedge_end(), false);
    for (IdType id : range) {
      HalfedgeId h = brep_.halfedge(id);
      if (owner(h) != id) {
        add(6, {id, h, owner(h)}, "the anchor of " + to_string(id) + " is " + to_string(h) + ", which belongs to " + to_string(owner(h)));
        continue;
      }
      while (!seen[h.index]) {
        seen[h.index] = true;
        if (owner(h) != id) {
          add(rule, {h, id, owner(h)},
              to_string(h) + " names " + to_string(owner(h)) + ", but the walk " + walk + " from " + to_string(brep_.halfedge(id)) +
                  ", the anchor of " + to_string(id) + ", passes it");
        }
        h = step(h);
      }
    }
    each_halfedge([&](HalfedgeId h) {
      if (seen[h.index]) return;
      const IdType id = owner(h);
      add(rule, {id, h},
          to_string(id) + " is also named by " + to_string(h) + ", which the walk " + walk + " from its anchor " +
              to_string(brep_.halfedge(id)) + " never reaches: " + cause);
      for (HalfedgeId x = h; !seen[x.index]; x = step(x)) seen[x.index] = true;  // one sentence for each further walk
    });
  }
  void explain_loops() {
    explain<FaceId>(
        faces(brep_), [&](HalfedgeId h) { return brep_.face(h); }, [&](HalfedgeId h) { return brep_.next(h); }, 4, "by next",
        "the face has two loops, or lies on edges of another; usually a half-edge that was not relabelled");
  }
  void explain_orbits() {
    explain<VertexId>(
        vertices(brep_), [&](HalfedgeId h) { return brep_.vertex(h); }, [&](HalfedgeId h) { return brep_.next(twin(h)); }, 5,
        "by next(twin)", "the vertex has two fans; usually a join over an edge whose ends meet twice");
  }

  void check_euler() {
    const long v = static_cast<long>(brep_.vertex_count()), e = static_cast<long>(brep_.edge_count()),
               f = static_cast<long>(brep_.face_count());
    if ((v - e + f) % 2 == 0) return;
    add(8, {}, "v - e + f = " + std::to_string(v) + " - " + std::to_string(e) + " + " + std::to_string(f) + " is odd");
  }

  const B& brep_;
  std::vector<Fault> faults_;
  bool loops_are_closed_ = true;   // next and prev are inverse and keep the face
  bool orbits_are_closed_ = true;  // next(twin) keeps the vertex
};

}  // namespace detail

// All faults of the records; empty for a valid BRep. Fault texts name elements by handle, so they can be looked up.
template <class B>
[[nodiscard]] std::vector<Fault> validate(const B& brep) {
  return detail::Validation<B>(brep).run();
}

}  // namespace brep
