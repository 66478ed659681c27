// SPDX-License-Identifier: MIT
#pragma once

// The slow pass of the validator: looks at a BRep that is not valid and writes a sentence for each fault.
//
// A sentence says what is wrong, where, how it can be seen, and the usual cause. The rules are those of validate.hpp and are
// looked at in the order R7 (which slots live), R1 (which handles may be followed), R3, R2 (single steps), R6, R4, R5
// (walks), R8 (shells). A walk stops at a link that has been reported. The half-edges beyond it are not reported as a second loop:
// such sentences are only written where all links are sound. Linear time and memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>

namespace brep {

struct Fault {
  int rule;                       // 1 to 8 structure, from 9 on constraints
  std::vector<Element> elements;  // in the order in which the sentence names them
  std::string sentence;           // begins with the rule: "R5: ..."
};

namespace detail {

inline Fault fault(int rule, std::vector<Element> elements, const std::string& text) {
  std::string sentence = "R";
  sentence += std::to_string(rule);
  return {rule, std::move(elements), sentence + ": " + text};
}

template <class B>
class Explanation {
 public:
  explicit Explanation(const B& brep) : brep_(brep) {}

  std::vector<Fault> run() {
    check_pool(Raw::halfedges(brep_), 2, "edges", [](std::uint32_t i) { return Element(edge(HalfedgeId{i})); });
    check_pool(Raw::vertices(brep_), 1, "vertices", [](std::uint32_t i) { return Element(VertexId{i}); });
    check_pool(Raw::faces(brep_), 1, "faces", [](std::uint32_t i) { return Element(FaceId{i}); });
    check_handles();
    check_steps();
    check_loops();
    check_orbits();
    if (links_are_sound_) { check_shells(); }
    return std::move(faults_);
  }

 private:
  void add(int rule, std::vector<Element> elements, const std::string& text) { faults_.push_back(fault(rule, std::move(elements), text)); }
  template <class Visit>
  void each_halfedge(Visit&& visit) const {
    for (std::uint32_t i = 0; i < brep_.halfedge_end(); ++i) {
      if (brep_.alive(HalfedgeId{i})) { visit(HalfedgeId{i}); }
    }
  }

  template <class PoolType, class Name>
  void check_pool(const PoolType& pool, std::uint32_t step, const char* kind, Name&& name) {
    std::vector<bool> listed(pool.size(), false);
    Element before;
    for (std::uint32_t i = pool.first_free(); i != PoolType::end_of_list; i = link(pool[i]) & ~PoolType::dead_bit) {
      const Element here = i < pool.size() ? name(i) : Element{};
      const auto place = [&] {
        return std::string("the free list of the ") + kind +
               (before.letter == 0 ? std::string(" begins with ") : " goes from " + to_string(before) + " to ");
      };
      if (i >= pool.size() || i % step != 0) {
        add(7, {before}, place() + "a slot that does not exist; the records were overwritten");
        break;
      }
      if (pool.alive(i)) {
        add(7, {here, before}, place() + to_string(here) + ", which is alive; usually a record written after its element was killed");
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
      if (pool.alive(i)) {
        ++live;
      } else if (!listed[i]) {
        add(7, {name(i)}, to_string(name(i)) + " is dead but not in the free list: its handle can never be used again");
      }
    }
    if (live != pool.count()) {
      add(8, {},
          std::to_string(live) + " " + kind + " are alive, but " + std::to_string(pool.count()) +
              " are counted; usually a record was made or killed without its pool");
    }
  }

  template <char Letter>
  [[nodiscard]] bool check_handle(Element owner, const char* field, Id<Letter> id) {
    if (brep_.alive(id)) { return true; }
    add(1, {owner, id},
        to_string(owner) + " has the " + field + " " + to_string(id) + ", which is not alive; usually a handle kept over a kill");
    return false;
  }
  void check_handles() {
    each_halfedge([&](HalfedgeId h) {
      const HalfedgeRecord& r = Raw::at(brep_, h);
      if (!check_handle(h, "next", r.next)) { links_are_sound_ = false; }
      if (!check_handle(h, "prev", r.prev)) { links_are_sound_ = false; }
      if (!check_handle(h, "vertex", r.vertex)) { vertices_are_alive_ = false; }
      if (!check_handle(h, "face", r.face)) { faces_are_alive_ = false; }
    });
    for (FaceId f : faces(brep_)) { faces_are_alive_ &= check_handle(f, "anchor", brep_.halfedge(f)); }
    for (VertexId v : vertices(brep_)) { vertices_are_alive_ &= check_handle(v, "anchor", brep_.halfedge(v)); }
  }

  // What can be seen at one half-edge.
  void check_steps() {
    each_halfedge([&](HalfedgeId h) {
      const HalfedgeRecord& r = Raw::at(brep_, h);
      if (brep_.alive(r.next)) {
        const HalfedgeRecord& after = Raw::at(brep_, r.next);
        if (after.prev != h) {
          links_are_sound_ = false;
          add(3, {h, r.next, after.prev},
              "next(" + to_string(h) + ") is " + to_string(r.next) + ", but prev(" + to_string(r.next) + ") is " + to_string(after.prev) +
                  "; usually one of the two links was not set");
        }
        const VertexId end = brep_.target(h);
        if (after.vertex != end && brep_.alive(after.vertex) && brep_.alive(end)) {
          add(2, {h, end, r.next, after.vertex},
              to_string(h) + " ends at " + to_string(end) + ", but its next, " + to_string(r.next) + ", starts at " +
                  to_string(after.vertex) + "; usually a vertex that was changed at a part of its half-edges");
        }
      }
      if (brep_.alive(r.prev)) {
        const HalfedgeId back = brep_.next(r.prev);
        if (back != h) {
          links_are_sound_ = false;
          add(3, {h, r.prev, back},
              "prev(" + to_string(h) + ") is " + to_string(r.prev) + ", but next(" + to_string(r.prev) + ") is " + to_string(back) +
                  "; usually one of the two links was not set");
        }
      }
    });
  }

  // A rule about walks along half-edges, and the usual cause of an offence.
  struct WalkRule {
    int number;
    const char *walk, *cause;
  };
  // Marks the walk from each anchor, then looks at every half-edge that was not met.
  // A step leads from h to next(from(h)).
  template <class IdType, class Range, class Owner, class From>
  void check_walks(Range&& range, Owner&& owner, From&& from, bool complete, const WalkRule& rule) {
    std::vector<bool> seen(brep_.halfedge_end(), false);
    bool anchored = true;
    for (IdType id : range) {
      HalfedgeId h = brep_.halfedge(id);
      if (!brep_.alive(h)) {
        continue;  // R1
      }
      if (owner(h) != id) {
        anchored = false;
        add(6, {id, h, owner(h)},
            "the anchor of " + to_string(id) + " is " + to_string(h) + ", which belongs to " + to_string(owner(h)) +
                "; usually an anchor kept while its half-edge went to another element");
        continue;
      }
      while (!seen[h.index]) {
        seen[h.index] = true;
        if (owner(h) != id && brep_.alive(owner(h))) {
          add(rule.number, {h, id, owner(h)},
              to_string(h) + " names " + to_string(owner(h)) + ", but the walk " + rule.walk + " from " + to_string(brep_.halfedge(id)) +
                  ", the anchor of " + to_string(id) + ", passes it; usually a half-edge that was not relabelled");
        }
        const HalfedgeId after = brep_.next(from(h));
        if (!brep_.alive(after) || brep_.prev(after) != from(h)) {
          break;  // R1, R3
        }
        h = after;
      }
    }
    if (!complete || !anchored) {
      return;  // what was not met may be beyond a fault that has its sentence already
    }
    each_halfedge([&](HalfedgeId h) {
      if (seen[h.index]) { return; }
      const IdType id = owner(h);
      add(rule.number, {id, h},
          to_string(id) + " is also named by " + to_string(h) + ", which the walk " + rule.walk + " from its anchor " +
              to_string(brep_.halfedge(id)) + " never reaches: " + rule.cause);
      for (HalfedgeId x = h; !seen[x.index]; x = brep_.next(from(x))) {
        seen[x.index] = true;  // one sentence for each further walk
      }
    });
  }
  void check_loops() {
    check_walks<FaceId>(
        faces(brep_), [&](HalfedgeId h) { return brep_.face(h); }, [](HalfedgeId h) { return h; }, links_are_sound_ && faces_are_alive_,
        {4, "by next", "the face has two loops; usually a split without a new face, or a join of faces that share no edge"});
  }
  void check_orbits() {
    check_walks<VertexId>(
        vertices(brep_), [&](HalfedgeId h) { return brep_.vertex(h); }, [](HalfedgeId h) { return twin(h); },
        links_are_sound_ && vertices_are_alive_,
        {5, "by next(twin)", "the vertex has two fans; usually a join over an edge whose ends meet twice"});
  }

  // A vertex or face counts in the shell of its anchor.
  void check_shells() {
    std::vector<std::uint32_t> shell_of(brep_.halfedge_end(), invalid_index);
    std::vector<HalfedgeId> roots, waiting;
    std::vector<long> v, e, f;
    each_halfedge([&](HalfedgeId root) {
      if (shell_of[root.index] != invalid_index) { return; }
      const auto shell = static_cast<std::uint32_t>(roots.size());
      roots.push_back(root);
      for (auto* count : {&v, &e, &f}) { count->push_back(0); }
      const auto reach = [&](HalfedgeId h) {
        if (shell_of[h.index] != invalid_index) { return; }
        shell_of[h.index] = shell;
        e[shell] += h.index % 2 == 0;
        waiting.push_back(h);
      };
      reach(root);
      while (!waiting.empty()) {
        const HalfedgeId h = waiting.back();
        waiting.pop_back();
        reach(twin(h));
        reach(brep_.next(h));
      }
    });
    for (VertexId x : vertices(brep_)) {
      if (brep_.alive(brep_.halfedge(x))) { ++v[shell_of[brep_.halfedge(x).index]]; }
    }
    for (FaceId x : faces(brep_)) {
      if (brep_.alive(brep_.halfedge(x))) { ++f[shell_of[brep_.halfedge(x).index]]; }
    }
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const long sum = v[i] - e[i] + f[i];
      if (sum <= 2 && sum % 2 == 0) { continue; }
      add(8, {roots[i]},
          "in the shell of " + to_string(roots[i]) + " v - e + f = " + std::to_string(v[i]) + " - " + std::to_string(e[i]) + " + " +
              std::to_string(f[i]) + " = " + std::to_string(sum) +
              ", but a closed shell has 2, 0, -2, ...; the other faults are the cause");
    }
  }

  const B& brep_;
  std::vector<Fault> faults_;
  bool links_are_sound_ = true;     // next and prev are alive and inverse
  bool vertices_are_alive_ = true;  // those that half-edges name, and the anchors of vertices
  bool faces_are_alive_ = true;
};

}  // namespace detail

}  // namespace brep
