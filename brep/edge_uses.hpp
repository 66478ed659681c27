// SPDX-License-Identifier: MIT
#pragma once

// The edges of a builder whose faces need not fit together: which faces run along an edge and in which direction, which faces must be
// flipped so that neighbours agree, and the borders where a face is missing. Diagnosis, repair and statistics stand on it. (close()
// pairs half-edges by a faster way, builder.hpp, as long as everything fits.)
//
// An edge is a pair of vertices, its uses are corners: a corner stands for the way from its vertex to that of the next corner. Faces
// that are wrong by themselves (unusable()) use no edge. Time: one sort of the corners.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include <brep/builder_input.hpp>
#include <brep/union_find.hpp>

namespace brep::detail {

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
        if (skip[f]) { continue; }
        const std::uint32_t u = corners[k], w = corners[after];
        uses_.push_back({std::min(u, w), std::max(u, w), first + k, u < w});
      }
    }
    std::sort(uses_.begin(), uses_.end(),
              [](const Use& a, const Use& b) { return std::tie(a.lo, a.hi, a.corner) < std::tie(b.lo, b.hi, b.corner); });
    for (std::uint32_t i = 0; i < uses_.size(); ++i) {
      if (i == 0 || uses_[i].lo != uses_[i - 1].lo || uses_[i].hi != uses_[i - 1].hi) { first_.push_back(i); }
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

// Which faces must be flipped so that neighbours agree, and where that is impossible.
//
// Two faces agree when they run along their common edge in opposite directions. Over the edges with exactly two faces the
// agreement is carried from face to face; so the faces fall into parts, and in each part every face runs with the first one or
// against it. The minority is flipped, in a tie those who run against the first face. A part where two ways around lead to
// different answers has only one side, as a Moebius strip has; nothing in it is flipped.
struct FlipPlan {
  std::vector<std::uint32_t> part;  // of each face; invalid_index for skipped faces
  std::vector<bool> flip;           // of each face
  std::vector<bool> one_sided;      // of each part

  FlipPlan(const Builder& builder, const EdgeUses& uses, const std::vector<bool>& skip)
      : part(builder.face_count(), invalid_index), flip(builder.face_count(), false) {
    std::vector<std::uint32_t> members;
    for (std::uint32_t seed = 0; seed < builder.face_count(); ++seed) {
      if (skip[seed] || part[seed] != invalid_index) { continue; }
      const auto id = static_cast<std::uint32_t>(one_sided.size());
      one_sided.push_back(false);
      part[seed] = id;
      members.assign(1, seed);
      std::size_t against = 0;
      for (std::size_t i = 0; i < members.size(); ++i) {
        const std::uint32_t f = members[i], first = builder.first_corner(f);
        against += flip[f] ? 1 : 0;
        for (std::uint32_t c = first; c < first + builder.corners(f).size(); ++c) {
          const auto pair = uses.of(uses.edge(c));
          if (pair.size() != 2) { continue; }
          const std::uint32_t g = uses.face(pair[pair[0].corner == c ? 1 : 0].corner);
          const bool expected = flip[f] != (pair[0].forward == pair[1].forward);
          if (part[g] == invalid_index) {
            part[g] = id;
            flip[g] = expected;
            members.push_back(g);
          } else if (flip[g] != expected) {
            one_sided[id] = true;
          }
        }
      }
      const bool majority = 2 * against > members.size();
      for (std::uint32_t f : members) { flip[f] = !one_sided[id] && flip[f] != majority; }
    }
  }
};

// The borders of an open surface as chains of edges that have a face on one side only.
//
// A border runs as its faces do, after the flips of a FlipPlan. Where several borders touch in a vertex they are told apart so that
// no chain visits a vertex twice. On an oriented surface every chain is closed; a chain that is not ends at an edge where
// more than two faces meet, or on a one-sided part.
struct Border {
  struct Edge {
    std::uint32_t from, to, corner;
  };
  std::vector<Edge> edges;
  bool closed;
};

// Edges that touch a vertex of `excused` are left out.
[[nodiscard]] inline std::vector<Border> borders(const EdgeUses& uses, const FlipPlan& orientation, const std::vector<bool>& excused) {
  std::vector<Border::Edge> open;
  std::vector<std::uint32_t> enters(excused.size(), 0), leaves(excused.size(), 0);
  for (std::uint32_t e = 0; e < uses.edge_count(); ++e) {
    const EdgeUses::Use& use = uses.of(e).front();
    if (uses.of(e).size() != 1 || excused[use.lo] || excused[use.hi]) { continue; }
    const bool flip = orientation.flip[uses.face(use.corner)];
    open.push_back({flip ? use.to() : use.from(), flip ? use.from() : use.to(), use.corner});
    ++leaves[open.back().from];
    ++enters[open.back().to];
  }
  std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return std::tie(a.from, a.corner) < std::tie(b.from, b.corner); });
  std::vector<std::uint32_t> cursor(excused.size(), 0);  // open edges by origin: those not yet taken begin here
  for (std::uint32_t i = static_cast<std::uint32_t>(open.size()); i-- > 0;) { cursor[open[i].from] = i; }
  const auto take = [&](std::uint32_t v) {
    if (leaves[v] == 0) { return invalid_index; }
    --leaves[v];
    return cursor[v]++;
  };

  std::vector<Border> all;
  std::vector<Border::Edge> path;
  std::vector<std::uint32_t> place(excused.size(), invalid_index);  // on the path: where the edge that leaves the vertex stands
  const auto follow = [&](std::uint32_t start) {
    path.clear();
    place[start] = 0;
    for (std::uint32_t v = start, i = take(v); i != invalid_index; i = take(v)) {
      path.push_back(open[i]);
      v = open[i].to;
      if (place[v] == invalid_index) {
        place[v] = static_cast<std::uint32_t>(path.size());
        continue;
      }
      all.push_back({{path.begin() + place[v], path.end()}, true});
      for (std::size_t k = place[v] + 1; k < path.size(); ++k) { place[path[k].from] = invalid_index; }
      path.resize(place[v]);
    }
    for (const Border::Edge& e : path) { place[e.from] = place[e.to] = invalid_index; }
    place[start] = invalid_index;
    if (!path.empty()) { all.push_back({path, false}); }
  };
  std::vector<std::uint32_t> starts;  // chains that cannot close begin where more edges leave than enter
  for (const Border::Edge& e : open) {
    if (enters[e.from] < leaves[e.from]) { starts.push_back(e.from); }
  }
  for (std::uint32_t v : starts) { follow(v); }
  for (const Border::Edge& e : open) {
    while (leaves[e.from] > 0) { follow(e.from); }
  }
  return all;
}

// Joins the fans that a face in each closed border would join.
inline void join_across(UnionFind& fans, const std::vector<Border>& borders, const EdgeUses& uses) {
  const auto corner_at = [&](const Border::Edge& e, std::uint32_t v) {
    const auto pair = uses.of(uses.edge(e.corner));
    return uses.corner_at(pair.front(), v);
  };
  for (const Border& border : borders) {
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
      const bool last = i + 1 == border.edges.size();
      if (last && !border.closed) { continue; }
      const Border::Edge& here = border.edges[i];
      fans.unite(corner_at(here, here.to), corner_at(border.edges[last ? 0 : i + 1], here.to));
    }
  }
}

}  // namespace brep::detail
