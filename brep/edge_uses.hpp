// SPDX-License-Identifier: MIT
#pragma once

// Which faces of a builder run along which edge, and in which direction: any number of them.
//
// stitch.hpp pairs half-edges and is fast as long as everything fits; here nothing needs to fit. Diagnosis, repair and statistics
// stand on it. An edge is a pair of vertices, its uses are corners: a corner stands for the way from its vertex to that of
// the next corner. Faces that make no sense by themselves (unusable()) use no edge. Time: one sort of the corners.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include <brep/builder_input.hpp>

namespace brep::detail {

// Sets that are merged (Tarjan 1975, with path halving); the smallest member represents a set.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  [[nodiscard]] std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Faces with fewer than three corners, with a corner that does not exist, or with a vertex that they visit twice.
[[nodiscard]] inline std::vector<bool> unusable(const Builder& builder) {
  std::vector<bool> bad(builder.face_count(), false);
  std::vector<std::uint32_t> seen(builder.vertex_count(), invalid_index);
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    bad[f] = builder.corners(f).size() < 3;
    for (std::uint32_t v : builder.corners(f)) {
      if (v >= seen.size() || seen[v] == f) {
        bad[f] = true;
      } else {
        seen[v] = f;
      }
    }
  }
  return bad;
}

class EdgeUses {
 public:
  struct Use {
    std::uint32_t lo, hi, corner;
    bool forward;  // it runs from lo to hi
    [[nodiscard]] std::uint32_t from() const { return forward ? lo : hi; }
    [[nodiscard]] std::uint32_t to() const { return forward ? hi : lo; }
  };

  EdgeUses(const Builder& builder, const std::vector<bool>& skip)
      : face_(builder.corner_count()), next_(builder.corner_count()), edge_(builder.corner_count(), invalid_index) {
    uses_.reserve(builder.corner_count());
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      const auto corners = builder.corners(f);
      const std::uint32_t first = builder.first_corner(f), count = static_cast<std::uint32_t>(corners.size());
      for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t after = k + 1 < count ? k + 1 : 0;
        face_[first + k] = f;
        next_[first + k] = first + after;
        if (skip[f]) continue;
        const std::uint32_t u = corners[k], w = corners[after];
        uses_.push_back({std::min(u, w), std::max(u, w), first + k, u < w});
      }
    }
    std::sort(uses_.begin(), uses_.end(),
              [](const Use& a, const Use& b) { return std::tie(a.lo, a.hi, a.corner) < std::tie(b.lo, b.hi, b.corner); });
    for (std::uint32_t i = 0; i < uses_.size(); ++i) {
      if (i == 0 || uses_[i].lo != uses_[i - 1].lo || uses_[i].hi != uses_[i - 1].hi) first_.push_back(i);
      edge_[uses_[i].corner] = static_cast<std::uint32_t>(first_.size() - 1);
    }
    first_.push_back(static_cast<std::uint32_t>(uses_.size()));
  }

  [[nodiscard]] std::uint32_t edge_count() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  [[nodiscard]] std::span<const Use> of(std::uint32_t edge) const {
    return std::span(uses_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }
  [[nodiscard]] std::uint32_t edge(std::uint32_t corner) const { return edge_[corner]; }  // invalid_index on a skipped face
  [[nodiscard]] std::uint32_t face(std::uint32_t corner) const { return face_[corner]; }
  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return next_[corner]; }
  // The corner of the use's face at v, an end of the edge.
  [[nodiscard]] std::uint32_t corner_at(const Use& use, std::uint32_t v) const { return use.from() == v ? use.corner : next_[use.corner]; }

  // The corners of each fan are one set: those of faces that meet at an edge of the vertex, however many they are.
  [[nodiscard]] UnionFind fans() const {
    UnionFind sets(face_.size());
    for (std::uint32_t e = 0; e < edge_count(); ++e) {
      const Use& first = of(e).front();
      for (const Use& use : of(e).subspan(1)) {
        sets.unite(corner_at(first, first.lo), corner_at(use, first.lo));
        sets.unite(corner_at(first, first.hi), corner_at(use, first.hi));
      }
    }
    return sets;
  }

 private:
  std::vector<Use> uses_;                          // sorted by edge, then by corner
  std::vector<std::uint32_t> first_;               // of each edge, and the end
  std::vector<std::uint32_t> face_, next_, edge_;  // of each corner
};

}  // namespace brep::detail
