// SPDX-License-Identifier: MIT
#pragma once

// The triangles of an outline that overlap least. Every outline has them: one that comes within rounding of itself or across, one that
// looks warped, one that crosses itself.
//
// All triangulations of an outline have the same area, signs included. So the triangles cover more than the outline by twice the area of
// those that are turned over, and that area is least here. Where the outline would be simple if its corners moved by at most d,
// it is of the order of d times the extent. Areas up to the tolerance of the outline count as turned over, each by what it falls
// short; of triangulations that are equal in this, the one with the shortest diagonals is taken.
//
// Found by dynamic programming over the polygons i, i+1, ..., j of the outline (Gilbert 1979, Klincsek 1980).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/outline.hpp>

namespace brep {

// A quarter of a second and 24 MB for so many corners; ears() and AtLeastOverlap ask for no more.
inline constexpr std::size_t most_corners_of_least_overlap = 1024;

// Corners of the triangles, in the order of the outline: n - 2 of them.                    Time: O(n^3), memory: O(n^2).
[[nodiscard]] inline std::vector<std::array<std::uint32_t, 3>> least_overlap(const Outline& outline) {
  struct Cost {
    double turned_over = 0.0, length = 0.0;
    bool operator<(const Cost& other) const {
      return turned_over != other.turned_over ? turned_over < other.turned_over : length < other.length;
    }
  };
  const std::size_t n = outline.size();
  std::vector<Cost> cost(n * n);              // of the polygon from i to j, at i n + j and at j n + i: the search below reads rows
  std::vector<std::uint32_t> apex(n * n, 0);  // of its triangle at the edge from i to j, at i n + j
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0, j = span; j < n; ++i, ++j) {
      Cost best{HUGE_VAL, HUGE_VAL};
      std::size_t best_apex = i + 1;
      const double length = glm::distance(outline[i], outline[j]);
      for (std::size_t k = i + 1; k < j; ++k) {
        const Cost &before = cost[i * n + k], &after = cost[j * n + k];
        if (before.turned_over + after.turned_over > best.turned_over) { continue; }
        const double missing = std::max(0.0, outline.tolerance() - outline.twice_area(i, k, j));
        const Cost sum{before.turned_over + after.turned_over + missing, before.length + after.length + length};
        if (sum < best) { best = sum, best_apex = k; }
      }
      cost[i * n + j] = cost[j * n + i] = best;
      apex[i * n + j] = static_cast<std::uint32_t>(best_apex);
    }
  }
  std::vector<std::array<std::uint32_t, 3>> result;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges{{0, static_cast<std::uint32_t>(n - 1)}};
  while (!edges.empty()) {
    const auto [i, j] = edges.back();
    edges.pop_back();
    if (j - i < 2) { continue; }
    const std::uint32_t k = apex[i * n + j];
    result.push_back({i, k, j});
    edges.push_back({i, k});
    edges.push_back({k, j});
  }
  return result;
}

}  // namespace brep
