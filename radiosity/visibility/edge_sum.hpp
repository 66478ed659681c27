// SPDX-License-Identifier: MIT
#pragma once

// A sum of directed edges of faces, in which an edge and its reverse cancel: if nothing remains, the faces form a closed surface.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace radiosity {

namespace detail {

inline constexpr double enclosure_slack = 1e-9;  // relative to the scene
inline constexpr std::size_t most_enclosure_parts = 1000;

// Sums up the directed edges of faces; the edges that do not cancel are the border.
class EdgeSum {
 public:
  void add(std::span<const glm::dvec3> contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) { add(corner(contour[i]), corner(contour[(i + 1) % contour.size()])); }
  }
  // The number of a corner; equal corners have equal numbers.
  [[nodiscard]] std::uint32_t corner(const glm::dvec3& p) {
    const auto [at, is_new] = corners_.try_emplace(
        {std::llround(std::ldexp(p.x, 30)), std::llround(std::ldexp(p.y, 30)), std::llround(std::ldexp(p.z, 30))}, positions_.size());
    if (is_new) { positions_.push_back(p); }
    return static_cast<std::uint32_t>(at->second);
  }
  using Edge = std::array<std::uint32_t, 2>;
  // The edges of which a part does not cancel, after each has been cut at the corners of others that lie on it; nothing if there are too
  // many.
  [[nodiscard]] std::optional<std::set<Edge>> border() const {
    std::vector<std::pair<Edge, int>> rest;
    std::vector<std::uint32_t> ends;
    for (const auto& [edge, times] : times_) {
      if (times == 0) { continue; }
      rest.push_back({edge, times});
      ends.insert(ends.end(), edge.begin(), edge.end());
    }
    if (rest.size() > most_enclosure_parts) { return {}; }
    EdgeSum pieces;
    std::map<Edge, std::vector<Edge>> owners;
    for (const auto& [edge, times] : rest) {
      const glm::dvec3 a = positions_[edge[0]];
      const glm::dvec3 along = positions_[edge[1]] - a;
      const double square = glm::dot(along, along);
      std::vector<std::pair<double, std::uint32_t>> on{{0.0, edge[0]}, {1.0, edge[1]}};
      for (const std::uint32_t c : ends) {
        const double t = glm::dot(positions_[c] - a, along) / square;
        if (c == edge[0] || c == edge[1] || t <= 0.0 || t >= 1.0) { continue; }
        if (glm::length(positions_[c] - a - t * along) <= enclosure_slack) { on.push_back({t, c}); }
      }
      std::sort(on.begin(), on.end());
      on.erase(std::unique(on.begin(), on.end()), on.end());
      for (std::size_t k = 1; k < on.size(); ++k) {
        pieces.add(on[k - 1].second, on[k].second, times);
        owners[between(on[k - 1].second, on[k].second)].push_back(edge);
      }
    }
    std::set<Edge> border;
    for (const auto& [piece, times] : pieces.times_) {
      if (times != 0) { border.insert(owners[piece].begin(), owners[piece].end()); }
    }
    return border;
  }
  [[nodiscard]] bool touches(const std::set<Edge>& border, std::span<const glm::dvec3> contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      if (border.contains(between(corner(contour[i]), corner(contour[(i + 1) % contour.size()])))) { return true; }
    }
    return false;
  }

 private:
  static Edge between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }
  void add(std::uint32_t a, std::uint32_t b, int times = 1) {
    if (a != b) { times_[between(a, b)] += a < b ? times : -times; }
  }

  std::map<std::array<long long, 3>, std::size_t> corners_;
  std::vector<glm::dvec3> positions_;
  std::map<Edge, int> times_;
};

}  // namespace detail

}  // namespace radiosity
