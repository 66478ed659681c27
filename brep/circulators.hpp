// SPDX-License-Identifier: MIT
#pragma once

// Walks over a BRep, as ranges for range-for (paper 2.2: "frequent tasks ... are encapsulated by iterator classes").
//
//   for (HalfedgeId h : halfedges_of(brep, f))    the loop of the face f, from its anchor
//   for (HalfedgeId h : halfedges_from(brep, v))  the half-edges that leave v, clockwise, from halfedge(v)
//   for (FaceId f : faces(brep))                  all living faces in index order; also vertices, edges
//
// A loop walk ends when it is back where it began, so the loop must not be changed while it is walked. The walks over all
// elements may see elements that were made on the way; killing the current one is allowed.

#include <cstddef>
#include <iterator>
#include <vector>

#include <brep/brep.hpp>

namespace brep {

namespace detail {

struct AroundFace {
  template <class B>
  static HalfedgeId step(const B& brep, HalfedgeId h) {
    return brep.next(h);
  }
};
struct AroundVertex {
  template <class B>
  static HalfedgeId step(const B& brep, HalfedgeId h) {
    return brep.next(twin(h));
  }
};

// A closed walk: steps until the first half-edge comes back.
template <class B, class Around>
class Circle {
 public:
  class iterator {
   public:
    using value_type = HalfedgeId;
    using difference_type = std::ptrdiff_t;
    using reference = HalfedgeId;
    using pointer = const HalfedgeId*;
    using iterator_category = std::forward_iterator_tag;

    iterator() = default;
    iterator(const B* brep, HalfedgeId first) : brep_(brep), first_(first), current_(first) {}
    HalfedgeId operator*() const { return current_; }
    iterator& operator++() {
      current_ = Around::step(*brep_, current_);
      if (current_ == first_) current_ = HalfedgeId{};
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) { return a.current_ == b.current_; }

   private:
    const B* brep_ = nullptr;
    HalfedgeId first_{}, current_{};
  };

  Circle(const B& brep, HalfedgeId first) : brep_(&brep), first_(first) {}
  iterator begin() const { return iterator(brep_, first_); }
  iterator end() const { return iterator(); }

 private:
  const B* brep_;
  HalfedgeId first_;
};

template <class IdType, class B>
std::uint32_t index_end(const B& brep) {
  if constexpr (std::is_same_v<IdType, VertexId>)
    return brep.vertex_end();
  else if constexpr (std::is_same_v<IdType, EdgeId>)
    return brep.edge_end();
  else
    return brep.face_end();
}

// All living elements of one kind.
template <class B, class IdType>
class All {
 public:
  class iterator {
   public:
    using value_type = IdType;
    using difference_type = std::ptrdiff_t;
    using reference = IdType;
    using pointer = const IdType*;
    using iterator_category = std::forward_iterator_tag;

    iterator() = default;
    explicit iterator(const B* brep) : brep_(brep), current_{0} { skip_dead(); }
    IdType operator*() const { return current_; }
    iterator& operator++() {
      ++current_.index;
      skip_dead();
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) { return a.current_ == b.current_; }

   private:
    void skip_dead() {
      const std::uint32_t end = index_end<IdType>(*brep_);
      while (current_.index < end && !brep_->alive(current_)) ++current_.index;
      if (current_.index >= end) current_ = IdType{};
    }
    const B* brep_ = nullptr;
    IdType current_{};
  };

  explicit All(const B& brep) : brep_(&brep) {}
  iterator begin() const { return iterator(brep_); }
  iterator end() const { return iterator(); }

 private:
  const B* brep_;
};

}  // namespace detail

template <class B>
[[nodiscard]] detail::Circle<B, detail::AroundFace> halfedges_of(const B& brep, FaceId f) {
  return {brep, brep.halfedge(f)};
}
template <class B>
[[nodiscard]] detail::Circle<B, detail::AroundVertex> halfedges_from(const B& brep, VertexId v) {
  return {brep, brep.halfedge(v)};
}
template <class B>
[[nodiscard]] auto vertices(const B& brep) {
  return detail::All<B, VertexId>(brep);
}
template <class B>
[[nodiscard]] auto edges(const B& brep) {
  return detail::All<B, EdgeId>(brep);
}
template <class B>
[[nodiscard]] auto faces(const B& brep) {
  return detail::All<B, FaceId>(brep);
}

// Number of half-edges on the loop of f.
template <class B>
[[nodiscard]] std::size_t degree(const B& brep, FaceId f) {
  std::size_t n = 0;
  for ([[maybe_unused]] HalfedgeId h : halfedges_of(brep, f)) ++n;
  return n;
}
// Number of half-edges that leave v; a loop edge counts twice.
template <class B>
[[nodiscard]] std::size_t degree(const B& brep, VertexId v) {
  std::size_t n = 0;
  for ([[maybe_unused]] HalfedgeId h : halfedges_from(brep, v)) ++n;
  return n;
}

// The number s of connected shells, by flood fill over the half-edges: O(e) time and memory.
template <class B>
[[nodiscard]] std::size_t shell_count(const B& brep) {
  std::vector<bool> seen(brep.halfedge_end(), false);
  std::vector<HalfedgeId> waiting;
  std::size_t shells = 0;
  const auto reach = [&](HalfedgeId h) {
    if (seen[h.index]) return;
    seen[h.index] = true;
    waiting.push_back(h);
  };
  for (EdgeId e : edges(brep)) {
    if (seen[halfedge(e).index]) continue;
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
