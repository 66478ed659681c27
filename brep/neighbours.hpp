// SPDX-License-Identifier: MIT
#pragma once

// What lies around an element: ranges for range-for that allocate nothing (paper 2.2, "iterator classes").
//
//   of a face f    vertices_of(b, f)  edges_of(b, f)  neighbours_of(b, f)     in the order of halfedges_of(b, f)
//   of a vertex v  edges_of(b, v)     faces_of(b, v)  neighbours_of(b, v)     in the order of halfedges_from(b, v), clockwise
//   of an edge e   halfedges_of(e)    vertices_of(b, e)  faces_of(b, e)       two of each: start and left side of the first half first
//   of all         halfedges(b)       both halves of each edge, in index order
//
// One entry for each half-edge of the walk. So in maps that are not simple an entry comes again: a vertex comes as often as the loop
// passes it, an edge with the face on both sides comes twice, a neighbour face as often as it shares an edge; a face is its own neighbour
// across a spur or a bridge, a vertex is its own neighbour along a loop edge. As with the walks below them, the topology must not
// change on the way.

#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include <brep/circulators.hpp>

namespace brep {

namespace detail {

struct ToVertex {
  template <class B>
  static VertexId get(const B& brep, HalfedgeId h) {
    return brep.vertex(h);
  }
};
struct ToTarget {
  template <class B>
  static VertexId get(const B& brep, HalfedgeId h) {
    return brep.target(h);
  }
};
struct ToEdge {
  template <class B>
  static EdgeId get(const B&, HalfedgeId h) {
    return edge(h);
  }
};
struct ToFace {
  template <class B>
  static FaceId get(const B& brep, HalfedgeId h) {
    return brep.face(h);
  }
};
struct ToOppositeFace {
  template <class B>
  static FaceId get(const B& brep, HalfedgeId h) {
    return brep.face(twin(h));
  }
};

// What `Get` finds at each half-edge of a closed walk.
template <class B, class Around, class Get>
class Seen {
  using Walk = typename Circle<B, Around>::iterator;

 public:
  class iterator {
   public:
    using value_type = decltype(Get::get(std::declval<const B&>(), HalfedgeId{}));
    using difference_type = std::ptrdiff_t;
    using reference = value_type;
    using pointer = const value_type*;
    using iterator_category = std::forward_iterator_tag;

    iterator() = default;
    iterator(const B* brep, Walk walk) : brep_(brep), walk_(walk) {}
    value_type operator*() const { return Get::get(*brep_, *walk_); }
    iterator& operator++() {
      ++walk_;
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) { return a.walk_ == b.walk_; }

   private:
    const B* brep_ = nullptr;
    Walk walk_{};
  };

  Seen(const B& brep, HalfedgeId first) : brep_(&brep), circle_(brep, first) {}
  [[nodiscard]] iterator begin() const { return iterator(brep_, circle_.begin()); }
  [[nodiscard]] iterator end() const { return iterator(brep_, circle_.end()); }

 private:
  const B* brep_;
  Circle<B, Around> circle_;
};

// Both halves of all living edges.
template <class B>
class AllHalfedges {
  using Walk = typename All<B, EdgeId>::iterator;

 public:
  class iterator {
   public:
    using value_type = HalfedgeId;
    using difference_type = std::ptrdiff_t;
    using reference = HalfedgeId;
    using pointer = const HalfedgeId*;
    using iterator_category = std::forward_iterator_tag;

    iterator() = default;
    explicit iterator(Walk walk) : walk_(walk) {}
    HalfedgeId operator*() const { return second_ ? twin(halfedge(*walk_)) : halfedge(*walk_); }
    iterator& operator++() {
      if (second_) ++walk_;
      second_ = !second_;
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) { return a.walk_ == b.walk_ && a.second_ == b.second_; }

   private:
    Walk walk_{};
    bool second_ = false;
  };

  explicit AllHalfedges(const B& brep) : edges_(brep) {}
  [[nodiscard]] iterator begin() const { return iterator(edges_.begin()); }
  [[nodiscard]] iterator end() const { return iterator(edges_.end()); }

 private:
  All<B, EdgeId> edges_;
};

}  // namespace detail

template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundFace, detail::ToVertex> vertices_of(const B& brep, FaceId f) {
  return {brep, brep.halfedge(f)};
}
template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundFace, detail::ToEdge> edges_of(const B& brep, FaceId f) {
  return {brep, brep.halfedge(f)};
}
// The faces on the other side of the edges of f.
template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundFace, detail::ToOppositeFace> neighbours_of(const B& brep, FaceId f) {
  return {brep, brep.halfedge(f)};
}

template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundVertex, detail::ToEdge> edges_of(const B& brep, VertexId v) {
  return {brep, brep.halfedge(v)};
}
// The face on the left of each half-edge that leaves v: one for each corner at v.
template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundVertex, detail::ToFace> faces_of(const B& brep, VertexId v) {
  return {brep, brep.halfedge(v)};
}
// The vertices at the other ends of the edges of v.
template <class B>
[[nodiscard]] detail::Seen<B, detail::AroundVertex, detail::ToTarget> neighbours_of(const B& brep, VertexId v) {
  return {brep, brep.halfedge(v)};
}

[[nodiscard]] constexpr std::array<HalfedgeId, 2> halfedges_of(EdgeId e) { return {halfedge(e), twin(halfedge(e))}; }
template <class B>
[[nodiscard]] std::array<VertexId, 2> vertices_of(const B& brep, EdgeId e) {
  return {brep.vertex(halfedge(e)), brep.target(halfedge(e))};
}
template <class B>
[[nodiscard]] std::array<FaceId, 2> faces_of(const B& brep, EdgeId e) {
  return {brep.face(halfedge(e)), brep.face(twin(halfedge(e)))};
}

template <class B>
[[nodiscard]] detail::AllHalfedges<B> halfedges(const B& brep) {
  return detail::AllHalfedges<B>(brep);
}

}  // namespace brep
