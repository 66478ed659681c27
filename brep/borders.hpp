// SPDX-License-Identifier: MIT
#pragma once

// The borders of an open surface as chains of edges that have a face on one side only.
//
// A border runs as its faces do, after the flips that orientation.hpp asks for. Where several borders touch in a vertex they
// are told apart so that no chain visits a vertex twice. On an oriented surface every chain is closed; a chain that is not
// ends at an edge where more than two faces meet, or on a one-sided patch.

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <brep/edge_uses.hpp>
#include <brep/orientation.hpp>

namespace brep::detail {

struct Border {
  struct Edge {
    std::uint32_t from, to, corner;
  };
  std::vector<Edge> edges;
  bool closed;
};

// Edges that touch a vertex of `excused` are left out.
[[nodiscard]] inline std::vector<Border> borders(const EdgeUses& uses, const Orientation& orientation, const std::vector<bool>& excused) {
  constexpr std::uint32_t none = invalid_index;
  std::vector<Border::Edge> open;
  std::vector<std::uint32_t> enters(excused.size(), 0), leaves(excused.size(), 0);
  for (std::uint32_t e = 0; e < uses.edge_count(); ++e) {
    const EdgeUses::Use& use = uses.of(e).front();
    if (uses.of(e).size() != 1 || excused[use.lo] || excused[use.hi]) continue;
    const bool flip = orientation.flip[uses.face(use.corner)];
    open.push_back({flip ? use.to() : use.from(), flip ? use.from() : use.to(), use.corner});
    ++leaves[open.back().from];
    ++enters[open.back().to];
  }
  std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return std::tie(a.from, a.corner) < std::tie(b.from, b.corner); });
  std::vector<std::uint32_t> cursor(excused.size(), 0);  // open edges by origin: those not yet taken begin here
  for (std::uint32_t i = static_cast<std::uint32_t>(open.size()); i-- > 0;) cursor[open[i].from] = i;
  const auto take = [&](std::uint32_t v) {
    if (leaves[v] == 0) return none;
    --leaves[v];
    return cursor[v]++;
  };

  std::vector<Border> all;
  std::vector<Border::Edge> path;
  std::vector<std::uint32_t> place(excused.size(), none);  // on the path: where the edge that leaves the vertex stands
  const auto follow = [&](std::uint32_t start) {
    path.clear();
    place[start] = 0;
    for (std::uint32_t v = start, i = take(v); i != none; i = take(v)) {
      path.push_back(open[i]);
      v = open[i].to;
      if (place[v] == none) {
        place[v] = static_cast<std::uint32_t>(path.size());
        continue;
      }
      all.push_back({{path.begin() + place[v], path.end()}, true});
      for (std::size_t k = place[v] + 1; k < path.size(); ++k) place[path[k].from] = none;
      path.resize(place[v]);
    }
    for (const Border::Edge& e : path) place[e.from] = place[e.to] = none;
    place[start] = none;
    if (!path.empty()) all.push_back({path, false});
  };
  std::vector<std::uint32_t> starts;  // chains that cannot close begin where more edges leave than enter
  for (const Border::Edge& e : open) {
    if (enters[e.from] < leaves[e.from]) starts.push_back(e.from);
  }
  for (std::uint32_t v : starts) follow(v);
  for (const Border::Edge& e : open) {
    while (leaves[e.from] > 0) follow(e.from);
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
      if (last && !border.closed) continue;
      const Border::Edge& here = border.edges[i];
      fans.unite(corner_at(here, here.to), corner_at(border.edges[last ? 0 : i + 1], here.to));
    }
  }
}

}  // namespace brep::detail
