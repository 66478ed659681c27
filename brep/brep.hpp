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
// levels are needed. Empty types cost nothing; inherit.hpp says what the data of a new element are. LogT is NoLog, or EulerLog
// (euler_log.hpp) for a BRep that can undo. All memory comes from AllocatorT (paper 2.2, "allocator class templates"), any allocator
// of the standard's kind, whatever its value type. Algorithms are free functions on any `B&`.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <brep/handles.hpp>
#include <brep/inherit.hpp>
#include <brep/pool.hpp>
#include <brep/step.hpp>

namespace brep {

struct NoData {};

namespace detail {

struct HalfedgeRecord {
  HalfedgeId next, prev;
  VertexId vertex;  // where it starts
  FaceId face;
};
static_assert(sizeof(HalfedgeRecord) == 16);

// A vertex or a face.
struct AnchorRecord {
  HalfedgeId halfedge;
};

inline std::uint32_t& link(HalfedgeRecord& r) { return r.next.index; }
inline std::uint32_t link(const HalfedgeRecord& r) { return r.next.index; }
inline std::uint32_t& link(AnchorRecord& r) { return r.halfedge.index; }
inline std::uint32_t link(const AnchorRecord& r) { return r.halfedge.index; }

struct Raw;

}  // namespace detail

template <class VertexT = NoData, class HalfedgeT = NoData, class FaceT = NoData, class LogT = NoLog, class AllocatorT = DefaultAllocator>
class BRep {
 public:
  using allocator_type = AllocatorT;
  BRep() : BRep(AllocatorT()) {}
  explicit BRep(const AllocatorT& allocator) : halfedges_(allocator), vertices_(allocator), faces_(allocator), log_(allocator) {}
  BRep(const BRep&) = default;  // allocators say themselves which one a copy gets: a polymorphic one gives the default resource
  BRep(BRep&&) noexcept = default;
  BRep(const BRep& other, const AllocatorT& allocator)
      : halfedges_(other.halfedges_, allocator),
        vertices_(other.vertices_, allocator),
        faces_(other.faces_, allocator),
        log_(other.log_, allocator) {}
  BRep(BRep&& other, const AllocatorT& allocator)
      : halfedges_(std::move(other.halfedges_), allocator),
        vertices_(std::move(other.vertices_), allocator),
        faces_(std::move(other.faces_), allocator),
        log_(std::move(other.log_), allocator) {}
  BRep& operator=(const BRep&) = default;  // the allocator stays
  BRep& operator=(BRep&&) noexcept = default;
  ~BRep() = default;
  [[nodiscard]] AllocatorT get_allocator() const { return halfedges_.allocator(); }

  static constexpr bool logs = !std::is_same_v<LogT, NoLog>;
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
    if constexpr (logs) { log_.record({Operator::set_anchor, false, h, halfedge(f), {}, {}, {}, {}, {}}); }
    faces_[f.index].halfedge = h;
  }

  // The references stay valid while the element lives, whatever else is made or killed.
  [[nodiscard]] VertexT& data(VertexId v) { return vertices_.data(v.index); }
  [[nodiscard]] const VertexT& data(VertexId v) const { return vertices_.data(v.index); }
  [[nodiscard]] FaceT& data(FaceId f) { return faces_.data(f.index); }
  [[nodiscard]] const FaceT& data(FaceId f) const { return faces_.data(f.index); }
  [[nodiscard]] HalfedgeT& data(HalfedgeId h) requires(!std::is_empty_v<HalfedgeT>) { return halfedges_.data(h.index); }
  [[nodiscard]] const HalfedgeT& data(HalfedgeId h) const requires(!std::is_empty_v<HalfedgeT>) { return halfedges_.data(h.index); }

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
  [[nodiscard]] std::size_t bytes() const { return halfedges_.bytes() + vertices_.bytes() + faces_.bytes(); }

 private:
  friend struct detail::Raw;

  Pool<detail::HalfedgeRecord, HalfedgeT, 2, AllocatorT> halfedges_;
  Pool<detail::AnchorRecord, VertexT, 1, AllocatorT> vertices_;
  Pool<detail::AnchorRecord, FaceT, 1, AllocatorT> faces_;
  [[no_unique_address]] typename LogT::template For<VertexT, HalfedgeT, FaceT, AllocatorT> log_;
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

  template <class B>
  static auto& log(B& brep) {
    return brep.log_;
  }
  // Writes an operator that is about to be applied into the log, if there is one. `h` is invalid for the edge to be made.
  template <class B>
  static void note([[maybe_unused]] B& brep, [[maybe_unused]] Operator op, [[maybe_unused]] HalfedgeId h, [[maybe_unused]] HalfedgeId a,
                   [[maybe_unused]] HalfedgeId b, [[maybe_unused]] bool alone = false) {
    if constexpr (B::logs) {
      const HalfedgeId p = h.valid() ? h : a, q = h.valid() ? twin(h) : b;
      Step step{op, alone, h.valid() ? h : HalfedgeId{brep.halfedges_.next_allocated()}, a, b, {}, {}, {}, {}};
      if (p.valid()) {
        step.face_a = brep.halfedge(brep.face(p)), step.face_b = brep.halfedge(brep.face(q));
        step.vertex_a = brep.halfedge(brep.vertex(p)), step.vertex_b = brep.halfedge(brep.vertex(q));
      }
      brep.log_.record(step);
    }
  }

  // The first half of a new edge, both halves with default data.
  template <class B>
  static HalfedgeId new_edge(B& brep) {
    const HalfedgeId h{brep.halfedges_.allocate()};
    if constexpr (B::logs && !std::is_empty_v<typename B::halfedge_type>) {
      brep.log_.give_back(brep.data(twin(h)));
      brep.log_.give_back(brep.data(h));
    }
    return h;
  }
  template <class B>
  static VertexId new_vertex(B& brep) {
    const VertexId v{brep.vertices_.allocate()};
    if constexpr (B::logs) { brep.log_.give_back(brep.data(v)); }
    return v;
  }
  template <class B>
  static VertexId new_vertex(B& brep, VertexId parent) {
    const VertexId v{brep.vertices_.allocate()};
    inherit_vertex(brep.data(v), brep.data(parent));
    if constexpr (B::logs) { brep.log_.give_back(brep.data(v)); }
    return v;
  }
  template <class B>
  static FaceId new_face(B& brep) {
    const FaceId f{brep.faces_.allocate()};
    if constexpr (B::logs) { brep.log_.give_back(brep.data(f)); }
    return f;
  }
  template <class B>
  static FaceId new_face(B& brep, FaceId parent) {
    const FaceId f{brep.faces_.allocate()};
    inherit_face(brep.data(f), brep.data(parent));
    if constexpr (B::logs) { brep.log_.give_back(brep.data(f)); }
    return f;
  }

  template <class B>
  static void kill(B& brep, EdgeId e) {
    const HalfedgeId h = brep::halfedge(e);
    if constexpr (B::logs && !std::is_empty_v<typename B::halfedge_type>) {
      brep.log_.keep(brep.data(h));
      brep.log_.keep(brep.data(twin(h)));
    }
    brep.halfedges_.release(h.index);
  }
  template <class B>
  static void kill(B& brep, VertexId v) {
    if constexpr (B::logs) { brep.log_.keep(brep.data(v)); }
    brep.vertices_.release(v.index);
  }
  template <class B>
  static void kill(B& brep, FaceId f) {
    if constexpr (B::logs) { brep.log_.keep(brep.data(f)); }
    brep.faces_.release(f.index);
  }
};

}  // namespace detail

}  // namespace brep
