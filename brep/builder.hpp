// SPDX-License-Identifier: MIT
#pragma once

// The construction phase (paper 2.2): vertices and faces in any order, without a look at consistency; then close().
//
// A Builder is not a template: it collects positions and polygons, and close<MyBRep>(builder) chooses the attributes. So an
// object writes its approximation once and every BRep can be built from it. Each polygon names its sheet: the smooth piece
// of the object's surface to which it belongs (a cylinder has three, a box six, a sphere one).
//
// Faces are counter-clockwise seen from outside the solid. close() either gives the BRep - closed, oriented, one fan at each vertex -
// or all defects at once, each with the elements that take part and a sentence. In defects v3 and f2 are the numbers that
// the builder gave; they are the handles of the finished BRep too: vertex i is VertexId{i}, face i is FaceId{i}, anchored at
// its first corner. What can be repaired, repair.hpp repairs on request.
//
// Time: O(v + sum of the lower degree over the edges), linear for every surface of bounded genus; about 25 ns a quadrilateral in
// warm memory (2-core EPYC). A builder with defects takes some five times as long, for the reports.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/diagnosis.hpp>
#include <brep/finite.hpp>

namespace brep {

namespace detail {

// Builds the BRep from the builder's corners in one pass, on the assumption that nothing is wrong.
//
// A corner becomes the half-edge from it to the next corner of its face; two that run along the same vertices in opposite directions
// are the halves of an edge. The edges met so far hang in chains, one for each vertex. An edge hangs at its end of lower number;
// should the chains get long (the tip of a cone), the work is done again with edges at their end of lower degree, where all chains
// together are short. Whatever does not fit ends the attempt without a message: diagnosis.hpp then finds what it is.
//
// Sound means here: every corner has a twin, no half-edge is used twice, and the walks around the vertices from their anchors
// meet as many half-edges as there are, so no vertex has a second fan.
template <class B>
class Stitching {
 public:
  Stitching(B& brep, const Builder& builder) : brep_(brep), builder_(builder) {}

  // Fills the empty BRep. False: the builder is not sound, and the BRep is rubbish.
  [[nodiscard]] bool run() {
    if (builder_.corner_count() % 2 != 0 || !make_vertices()) { return false; }
    make_faces();
    Raw::halfedges(brep_).append(static_cast<std::uint32_t>(edges_));
    links_ = std::make_unique_for_overwrite<Link[]>(edges_);
    bool sound = make_edges<false>();
    if (too_many_steps()) {
      count_degrees();
      sound = make_edges<true>();
    }
    return sound && used_ == edges_ && one_fan_each();
  }

 private:
  static constexpr std::uint32_t matched = 0x80000000, none = 0x7fffffff;
  struct Link {
    std::uint32_t key;   // the other end of the edge, twice, + 1 when the edge runs away from the vertex of the chain
    std::uint32_t next;  // edge in the chain, + matched when this one has both halves
  };

  bool make_vertices() {
    const std::uint32_t n = builder_.vertex_count();
    auto& pool = Raw::vertices(brep_);
    pool.append(n);
    bool finite = true;
    for (std::uint32_t v = 0; v < n; ++v) {
      pool[v].halfedge = HalfedgeId{};
      const glm::dvec3& p = builder_.position(v);
      finite = finite & is_finite(p);
      [[maybe_unused]] auto& data = pool.data(v);
      if constexpr (requires { data.position = p; }) { data.position = p; }
    }
    return finite;
  }

  void make_faces() {
    auto& pool = Raw::faces(brep_);
    pool.append(builder_.face_count());
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      [[maybe_unused]] auto& data = pool.data(f);
      if constexpr (requires { data.sheet = builder_.sheet(f); }) { data.sheet = builder_.sheet(f); }
    }
  }

  void count_degrees() {
    degrees_.assign(builder_.vertex_count(), 0);
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      for (std::uint32_t v : builder_.corners(f)) {
        if (v < degrees_.size()) { ++degrees_[v]; }
      }
    }
  }

  template <bool by_degree>
  bool make_edges() {
    used_ = 0;
    heads_.assign(vertices_, none);
    for (std::uint32_t i = 0; i < builder_.face_count(); ++i) {
      const std::span<const std::uint32_t> corners = builder_.corners(i);
      const bool sound = corners.size() == 4   ? make_face<by_degree>(FaceId{i}, corners.data(), std::make_index_sequence<4>())
                         : corners.size() == 3 ? make_face<by_degree>(FaceId{i}, corners.data(), std::make_index_sequence<3>())
                                               : make_face<by_degree>(FaceId{i}, corners);
      if (!sound) { return false; }
      if (!by_degree && too_many_steps()) { return false; }
    }
    return true;
  }
  [[nodiscard]] bool too_many_steps() const { return steps_ > 8 * edges_ + 1000; }

  // A face of n corners, without loops.
  template <bool by_degree, std::size_t... k>
  bool make_face(FaceId f, const std::uint32_t* corners, std::index_sequence<k...>) {
    constexpr std::size_t n = sizeof...(k);
    if (!are_different(corners, n)) { return false; }
    const HalfedgeId h[n] = {find<by_degree>(corners[k], corners[(k + 1) % n])...};
    if ((... || !h[k].valid())) { return false; }
    ((Raw::at(brep_, h[k]) = {h[(k + 1) % n], h[(k + n - 1) % n], VertexId{corners[k]}, f}), ...);
    ((Raw::at(brep_, VertexId{corners[k]}).halfedge = h[k]), ...);
    Raw::at(brep_, f).halfedge = h[0];
    return true;
  }

  template <bool by_degree>
  bool make_face(FaceId f, std::span<const std::uint32_t> corners) {
    if (!are_different(corners.data(), corners.size())) { return false; }
    HalfedgeId first{}, before{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const HalfedgeId h = find<by_degree>(corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
      if (!h.valid()) { return false; }
      Raw::at(brep_, h) = {h, before, VertexId{corners[k]}, f};
      Raw::at(brep_, VertexId{corners[k]}).halfedge = h;
      k == 0 ? first = h : Raw::at(brep_, before).next = h;
      before = h;
    }
    Raw::at(brep_, before).next = first;
    Raw::at(brep_, first).prev = before;
    Raw::at(brep_, f).halfedge = first;
    return true;
  }

  // At least three corners, all of them vertices, none twice.
  [[gnu::always_inline]] bool are_different(const std::uint32_t* corners, std::size_t n) {
    bool wrong = n < 3;
    for (std::size_t k = 0; k < n; ++k) { wrong = wrong | (corners[k] >= vertices_); }
    if (n <= 16) {
      for (std::size_t k = 1; k < n; ++k) {
        for (std::size_t j = 0; j < k; ++j) { wrong = wrong | (corners[j] == corners[k]); }
      }
      return !wrong;
    }
    if (wrong) { return false; }
    if (seen_.empty()) { seen_.assign(vertices_, false); }
    for (std::size_t k = 0; k < n; ++k) {
      wrong = wrong || seen_[corners[k]];
      seen_[corners[k]] = true;
    }
    for (std::size_t k = 0; k < n; ++k) { seen_[corners[k]] = false; }
    return !wrong;
  }

  // The half-edge from u to w: a new edge's first half, or the twin of one that was met before. Invalid: it is taken.
  template <bool by_degree>
  [[gnu::always_inline]] HalfedgeId find(std::uint32_t u, std::uint32_t w) {
    bool at_u = u < w;
    if constexpr (by_degree) { at_u = degrees_[u] != degrees_[w] ? degrees_[u] < degrees_[w] : at_u; }
    std::uint32_t& head = heads_[at_u ? u : w];
    const std::uint32_t key = 2 * (at_u ? w : u) + (at_u ? 1 : 0);
    std::size_t steps = 0;
    for (std::uint32_t e = head; e != none; ++steps) {
      Link& link = links_[e];
      const std::uint32_t difference = link.key ^ key;
      if (difference <= 1) {
        if (difference == 0 || (link.next & matched) != 0) { return {}; }
        link.next |= matched;
        return HalfedgeId{2 * e + 1};
      }
      e = link.next & ~matched;
    }
    if constexpr (!by_degree) { steps_ += steps; }
    if (used_ == edges_) { return {}; }
    links_[used_] = {key, head};
    head = static_cast<std::uint32_t>(used_);
    return HalfedgeId{2 * static_cast<std::uint32_t>(used_++)};
  }

  [[nodiscard]] bool one_fan_each() const {
    std::size_t met = 0;
    for (std::uint32_t v = 0; v < builder_.vertex_count(); ++v) {
      const HalfedgeId anchor = brep_.halfedge(VertexId{v});
      if (!anchor.valid()) { return false; }
      HalfedgeId h = anchor;
      do {
        h = brep_.next(twin(h));
        ++met;
      } while (h != anchor);
    }
    return met == builder_.corner_count();
  }

  B& brep_;
  const Builder& builder_;
  const std::size_t vertices_ = builder_.vertex_count();
  const std::size_t edges_ = builder_.corner_count() / 2;  // when all is sound
  std::size_t used_ = 0;                                   // edges met
  std::size_t steps_ = 0;                                  // along chains to edges that were new
  std::vector<std::uint32_t> heads_;                       // chain of a vertex
  std::unique_ptr<Link[]> links_;                          // of an edge
  std::vector<std::uint32_t> degrees_;
  std::vector<bool> seen_;
};

}  // namespace detail

template <class B>
struct BuildResult {
  std::optional<B> brep;  // exactly when there are no defects
  std::vector<Defect> defects;
};

// Builds the BRep, or reports every defect. Vertex data get `.position`, face data get `.sheet`, if they have such members.
// A defect that is only the consequence of a reported one (the border around a face with a bad index) is not reported.
// The BRep gets the allocator, if one is given; what close() needs meanwhile and the defects come from the heap.
template <class B, class... Allocator>
[[nodiscard]] BuildResult<B> close(const Builder& builder, const Allocator&... allocator) {
  static_assert(sizeof...(Allocator) <= 1);
  BuildResult<B> result;
  detail::Assembly assembly;  // the faces that are given by their edges, as corners
  if (!builder.edges().empty()) { assembly = detail::Assembler(builder).run(); }
  const Builder& corners = builder.edges().empty() ? builder : assembly.builder;
  if (assembly.defects.empty() && detail::Stitching<B>(result.brep.emplace(allocator...), corners).run()) { return result; }
  result.brep.reset();
  result.defects = diagnose(builder);
  assert(!result.defects.empty());
  return result;
}

}  // namespace brep
