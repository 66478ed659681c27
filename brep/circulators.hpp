// SPDX-License-Identifier: MIT
#pragma once

// Walks over a BRep, as ranges for range-for (paper 2.2: "frequent tasks ... are encapsulated by iterator classes").
//
//   for (HalfedgeId h : halfedges_of(brep, f))    the loop of the face f, from its anchor
//   for (HalfedgeId h : halfedges_from(brep, v))  the half-edges that leave v, clockwise, from halfedge(v)
//   for (FaceId f : faces(brep))                  all living faces in index order; also vertices, edges, halfedges
//
// A loop walk ends when it is back where it began, so the loop must not be changed while it is walked. The walks over all
// elements may see elements that were made on the way; killing the current one is allowed.

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <brep/brep.hpp>
#include <brep/range.hpp>

namespace brep {

namespace detail {

// Where a closed walk goes from h, and what it shows of it.
struct AroundFace {
  template <class B>
  HalfedgeId operator()(const B& brep, HalfedgeId h) const {
    return brep.next(h);
  }
};
struct AroundVertex {
  template <class B>
  HalfedgeId operator()(const B& brep, HalfedgeId h) const {
    return brep.next(twin(h));
  }
};
struct Itself {
  template <class B>
  HalfedgeId operator()(const B&, HalfedgeId h) const {
    return h;
  }
};

// A closed walk: steps until the first half-edge comes back.
template <class B, class Around, class Show>
struct Circle {
  const B* brep = nullptr;
  HalfedgeId first{}, current{};

  [[nodiscard]] auto value() const { return Show()(*brep, current); }
  void step() {
    current = Around()(*brep, current);
    if (current == first) { current = HalfedgeId{}; }
  }
  friend bool operator==(const Circle& a, const Circle& b) { return a.current == b.current; }
};

template <class Around, class Show, class B>
[[nodiscard]] auto circle(const B& brep, HalfedgeId first) {
  return Range(Circle<B, Around, Show>{&brep, first, first});
}

// All living elements of one kind.
template <class B, class IdType>
struct All {
  const B* brep = nullptr;
  IdType current{};

  [[nodiscard]] IdType value() const { return current; }
  void step() {
    ++current.index;
    skip_dead();
  }
  void skip_dead() {
    const std::uint32_t end = this->end();
    while (current.index < end && !brep->alive(current)) { ++current.index; }
    if (current.index >= end) { current = IdType{}; }
  }
  [[nodiscard]] std::uint32_t end() const {
    if constexpr (std::is_same_v<IdType, VertexId>) {
      return brep->vertex_end();
    } else if constexpr (std::is_same_v<IdType, HalfedgeId>) {
      return brep->halfedge_end();
    } else if constexpr (std::is_same_v<IdType, EdgeId>) {
      return brep->edge_end();
    } else {
      return brep->face_end();
    }
  }
  friend bool operator==(const All& a, const All& b) { return a.current == b.current; }
};

template <class IdType, class B>
[[nodiscard]] auto all(const B& brep) {
  All<B, IdType> walk{&brep, IdType{0}};
  walk.skip_dead();
  return Range(walk);
}

}  // namespace detail

template <class B>
[[nodiscard]] auto halfedges_of(const B& brep, FaceId f) {
  return detail::circle<detail::AroundFace, detail::Itself>(brep, brep.halfedge(f));
}
template <class B>
[[nodiscard]] auto halfedges_from(const B& brep, VertexId v) {
  return detail::circle<detail::AroundVertex, detail::Itself>(brep, brep.halfedge(v));
}
template <class B>
[[nodiscard]] auto vertices(const B& brep) {
  return detail::all<VertexId>(brep);
}
template <class B>
[[nodiscard]] auto edges(const B& brep) {
  return detail::all<EdgeId>(brep);
}
template <class B>
[[nodiscard]] auto halfedges(const B& brep) {
  return detail::all<HalfedgeId>(brep);
}
template <class B>
[[nodiscard]] auto faces(const B& brep) {
  return detail::all<FaceId>(brep);
}

// Number of half-edges on the loop of f.
template <class B>
[[nodiscard]] std::size_t degree(const B& brep, FaceId f) {
  std::size_t n = 0;
  for ([[maybe_unused]] HalfedgeId h : halfedges_of(brep, f)) { ++n; }
  return n;
}
// Number of half-edges that leave v; a loop edge counts twice.
template <class B>
[[nodiscard]] std::size_t degree(const B& brep, VertexId v) {
  std::size_t n = 0;
  for ([[maybe_unused]] HalfedgeId h : halfedges_from(brep, v)) { ++n; }
  return n;
}

// The number s of connected shells, by flood fill over the half-edges: O(e) time and memory.
template <class B>
[[nodiscard]] std::size_t shell_count(const B& brep) {
  std::vector<bool> seen(brep.halfedge_end(), false);
  std::vector<HalfedgeId> waiting;
  std::size_t shells = 0;
  const auto reach = [&](HalfedgeId h) {
    if (seen[h.index]) { return; }
    seen[h.index] = true;
    waiting.push_back(h);
  };
  for (EdgeId e : edges(brep)) {
    if (seen[halfedge(e).index]) { continue; }
    ++shells;
    reach(halfedge(e));
    while (!waiting.empty()) {
      const HalfedgeId h = waiting.back();
      waiting.pop_back();
      reach(twin(h));
      reach(brep.next(h));
    }
  }
  return shells;
}

// The number h of handles of all shells together, from v - e + f = 2(s - h): 0 for a sphere, 1 for a torus. O(e).
template <class B>
[[nodiscard]] long genus(const B& brep) {
  const long euler = static_cast<long>(brep.vertex_count()) - static_cast<long>(brep.edge_count()) + static_cast<long>(brep.face_count());
  return static_cast<long>(shell_count(brep)) - euler / 2;
}

}  // namespace brep
