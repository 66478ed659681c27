// SPDX-License-Identifier: MIT
#pragma once

// BRep: the topology of polyhedral boundaries, and the user's attributes on it (paper, section 2).
//
// A half-edge knows its successor and predecessor on the loop of its face, the vertex where it starts, and its face,
// which lies on its left. The invariant, kept by every operator of euler.hpp: each face and each vertex has exactly one
// closed succession of edges, and v - e + f = 2(s - h) for s shells with h handles. The surface is closed; it has no
// border, no face has two loops, no vertex two fans. Loops, spurs, faces of one or two edges and edges with the
// same face on both sides are legal.
//
//        next        *<----------*         The face f = face(h) lies left of h. Around a face: next, prev.
//          ^        /             \        Around a vertex: twin(prev(h)) is the next half-edge counter-clockwise
//          |       /       f       \       that leaves vertex(h), next(twin(h)) the next one clockwise.
//   vertex(h) ---h---> target(h)
//
// VertexT, HalfedgeT and FaceT are the user's own types, default-constructible and movable; derive Tag into them where
// levels are needed. Empty types cost nothing. FaceT is copied to the new face when a face is split (default-constructed if
// it cannot be copied); new vertices and half-edges start with default data. `B&` algorithms are free functions.

#include <array>
#include <cassert>
#include <cstddef>
#include <type_traits>

#include <brep/handles.hpp>
#include <brep/pool.hpp>

namespace brep {

struct NoData {};

namespace detail {

struct HalfedgeRecord {
  HalfedgeId next, prev;
  VertexId vertex;  // where it starts
  FaceId face;
};
static_assert(sizeof(HalfedgeRecord) == 16);

// A vertex or a face. The handle comes first: it never lies in the tail padding of the user's data, where a raw copy
// of the data would overwrite it.
template <class T>
struct ElementRecord {
  HalfedgeId halfedge;
  [[no_unique_address]] T data{};
};

inline std::uint32_t& link(HalfedgeRecord& r) { return r.next.index; }
inline std::uint32_t link(const HalfedgeRecord& r) { return r.next.index; }
template <class T>
std::uint32_t& link(ElementRecord<T>& r) {
  return r.halfedge.index;
}
template <class T>
std::uint32_t link(const ElementRecord<T>& r) {
  return r.halfedge.index;
}

struct Raw;

}  // namespace detail

template <class VertexT = NoData, class HalfedgeT = NoData, class FaceT = NoData>
class BRep {
 public:
  using vertex_type = VertexT;
  using halfedge_type = HalfedgeT;
  using face_type = FaceT;

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const { return halfedges_[h.index].next; }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const { return halfedges_[h.index].prev; }
  [[nodiscard]] VertexId vertex(HalfedgeId h) const { return halfedges_[h.index].vertex; }     // where h starts
  [[nodiscard]] VertexId target(HalfedgeId h) const { return vertex(twin(h)); }                // where h ends
  [[nodiscard]] FaceId face(HalfedgeId h) const { return halfedges_[h.index].face; }           // on its left
  [[nodiscard]] HalfedgeId halfedge(VertexId v) const { return vertices_[v.index].halfedge; }  // one that leaves v
  [[nodiscard]] HalfedgeId halfedge(FaceId f) const { return faces_[f.index].halfedge; }       // the anchor of its loop

  // The loop of f is walked from its anchor. `h` must lie on the loop of f.
  void set_anchor(FaceId f, HalfedgeId h) {
    assert(alive(h) && face(h) == f);
    faces_[f.index].halfedge = h;
  }

  // The references stay valid while the element lives, whatever else is made or killed.
  [[nodiscard]] VertexT& data(VertexId v) { return vertices_[v.index].data; }
  [[nodiscard]] const VertexT& data(VertexId v) const { return vertices_[v.index].data; }
  [[nodiscard]] FaceT& data(FaceId f) { return faces_[f.index].data; }
  [[nodiscard]] const FaceT& data(FaceId f) const { return faces_[f.index].data; }
  [[nodiscard]] HalfedgeT& data(HalfedgeId h) requires(!std::is_empty_v<HalfedgeT>) { return halfedge_data_[h.index]; }
  [[nodiscard]] const HalfedgeT& data(HalfedgeId h) const requires(!std::is_empty_v<HalfedgeT>) { return halfedge_data_[h.index]; }

  [[nodiscard]] std::size_t vertex_count() const { return vertices_.count(); }
  [[nodiscard]] std::size_t edge_count() const { return halfedges_.count(); }
  [[nodiscard]] std::size_t face_count() const { return faces_.count(); }

  [[nodiscard]] bool alive(VertexId v) const { return vertices_.alive(v.index); }
  [[nodiscard]] bool alive(HalfedgeId h) const { return halfedges_.alive(h.index); }
  [[nodiscard]] bool alive(EdgeId e) const { return e.index < edge_end() && alive(brep::halfedge(e)); }
  [[nodiscard]] bool alive(FaceId f) const { return faces_.alive(f.index); }

  // One more than the largest index that was ever used: the length of an array indexed by such handles.
  [[nodiscard]] std::uint32_t vertex_end() const { return vertices_.size(); }
  [[nodiscard]] std::uint32_t halfedge_end() const { return halfedges_.size(); }
  [[nodiscard]] std::uint32_t edge_end() const { return halfedges_.size() / 2; }
  [[nodiscard]] std::uint32_t face_end() const { return faces_.size(); }

  // Memory held by the pools, in bytes, free slots included; what the user's data own elsewhere is not counted.
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = halfedges_.bytes() + vertices_.bytes() + faces_.bytes();
    if constexpr (!std::is_empty_v<HalfedgeT>) sum += halfedge_data_.bytes();
    return sum;
  }

 private:
  friend struct detail::Raw;
  struct Empty {};
  using HalfedgeData = std::conditional_t<std::is_empty_v<HalfedgeT>, Empty, Pages<HalfedgeT, page_shift + 1>>;

  Pool<detail::HalfedgeRecord, 2> halfedges_;
  Pool<detail::ElementRecord<VertexT>> vertices_;
  Pool<detail::ElementRecord<FaceT>> faces_;
  [[no_unique_address]] HalfedgeData halfedge_data_;  // same indices as halfedges_
};

namespace detail {

// The records behind a BRep, for the operators, the builder, the validator and tests that damage a record on purpose.
// Whoever writes here answers for the invariant.
struct Raw {
  template <class B>
  static auto& halfedges(B& brep) {
    return brep.halfedges_;
  }
  template <class B>
  static auto& vertices(B& brep) {
    return brep.vertices_;
  }
  template <class B>
  static auto& faces(B& brep) {
    return brep.faces_;
  }

  template <class B>
  static auto& at(B& brep, HalfedgeId h) {
    return brep.halfedges_[h.index];
  }
  template <class B>
  static auto& at(B& brep, VertexId v) {
    return brep.vertices_[v.index];
  }
  template <class B>
  static auto& at(B& brep, FaceId f) {
    return brep.faces_[f.index];
  }

  // The first half of a new edge, both halves with default data.
  template <class B>
  static HalfedgeId new_edge(B& brep) {
    const HalfedgeId h{brep.halfedges_.allocate()};
    using Data = typename B::halfedge_type;
    if constexpr (!std::is_empty_v<Data>) {
      if (brep.halfedge_data_.size() < brep.halfedges_.size()) {
        brep.halfedge_data_.push_back();
        brep.halfedge_data_.push_back();
      } else if constexpr (std::is_trivially_destructible_v<Data>) {  // the others were reset by kill
        brep.data(h) = Data{};
        brep.data(twin(h)) = Data{};
      }
    }
    return h;
  }
  template <class B>
  static VertexId new_vertex(B& brep) {
    using Data = typename B::vertex_type;
    const VertexId v{brep.vertices_.allocate()};
    if constexpr (std::is_trivially_destructible_v<Data> && !std::is_empty_v<Data>) brep.data(v) = Data{};
    return v;
  }
  template <class B>
  static FaceId new_face(B& brep) {
    using Data = typename B::face_type;
    const FaceId f{brep.faces_.allocate()};
    if constexpr (std::is_trivially_destructible_v<Data> && !std::is_empty_v<Data>) brep.data(f) = Data{};
    return f;
  }
  template <class B>
  static FaceId new_face(B& brep, FaceId parent) {
    using Data = typename B::face_type;
    const FaceId f = new_face(brep);
    if constexpr (std::is_copy_assignable_v<Data> && !std::is_empty_v<Data>) brep.data(f) = brep.data(parent);
    return f;
  }

  // Data that own something let it go at once.
  template <class B>
  static void kill(B& brep, EdgeId e) {
    using Data = typename B::halfedge_type;
    if constexpr (!std::is_trivially_destructible_v<Data>) {
      brep.data(brep::halfedge(e)) = Data{};
      brep.data(twin(brep::halfedge(e))) = Data{};
    }
    brep.halfedges_.release(brep::halfedge(e).index);
  }
  template <class B>
  static void kill(B& brep, VertexId v) {
    using Data = typename B::vertex_type;
    if constexpr (!std::is_trivially_destructible_v<Data>) brep.data(v) = Data{};
    brep.vertices_.release(v.index);
  }
  template <class B>
  static void kill(B& brep, FaceId f) {
    using Data = typename B::face_type;
    if constexpr (!std::is_trivially_destructible_v<Data>) brep.data(f) = Data{};
    brep.faces_.release(f.index);
  }
};

}  // namespace detail

}  // namespace brep
