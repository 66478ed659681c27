// SPDX-License-Identifier: MIT
#pragma once

// Finds the triangle of a plane that contains a point: a grid over the plane, with further grids within cells of many triangles. So a
// point is found in a few steps, however many triangles there are and however unequal they are.
//
// Works in two coordinates: the one along which the plane's normal is longest is dropped, which does not change barycentric coordinates.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace radiosity {

class PlaneGrid {
 public:
  using Corners = std::array<glm::dvec3, 3>;

  PlaneGrid() = default;
  // Triangles of one plane. Those without area contain no point.
  explicit PlaneGrid(std::span<const Corners> triangles);

  struct Found {
    std::uint32_t triangle = 0;
    glm::dvec3 weight{0.0};  // barycentric
  };
  // The first triangle that contains a point of the plane, edges included. Nothing if there is none, or if a cell has too many triangles
  // that no grid can separate (slivers around a common corner); then another search must decide.
  [[nodiscard]] std::optional<Found> find(const glm::dvec3& point) const;

 private:
  // Barycentric coordinates of the second and third corner as linear functions of the point: g . (u, v) + g.z.
  struct Weights {
    glm::dvec3 second{0.0}, third{0.0};
    [[nodiscard]] glm::dvec3 at(const glm::dvec2& p) const {
      const double b = second.x * p.x + second.y * p.y + second.z, c = third.x * p.x + third.y * p.y + third.z;
      return {1.0 - b - c, b, c};
    }
  };
  struct Box {
    glm::dvec2 lo{0.0}, hi{0.0};
  };
  // A cell is a list of triangles, or contains another grid.
  struct Cell {
    std::uint32_t first = 0, count = 0;  // range in items_; or number of the grid and is_grid
  };
  struct Grid {
    glm::dvec2 lo{0.0}, cells_per_length{0.0};
    std::array<std::uint32_t, 2> size{};
    std::uint32_t first_cell = 0;
    // The cell that contains a point, or the nearest cell.
    [[nodiscard]] std::array<std::uint32_t, 2> cell_of(const glm::dvec2& p) const {
      const auto along = [&](int k) {
        const double at = (p[k] - lo[k]) * cells_per_length[k];
        return static_cast<std::uint32_t>(std::min(std::max(0.0, at), static_cast<double>(size[static_cast<std::size_t>(k)] - 1)));
      };
      return {along(0), along(1)};
    }
  };

  [[nodiscard]] glm::dvec2 flattened(const glm::dvec3& p) const { return {p[axes_[0]], p[axes_[1]]}; }
  [[nodiscard]] static Grid grid_over(const Box& box, double cells);
  // The box of a cell, slightly enlarged.
  [[nodiscard]] static Box box_of(const Grid& grid, std::uint32_t x, std::uint32_t y);
  [[nodiscard]] static bool meets(const Weights& triangle, const Box& cell);
  // The triangles of each cell; nothing if that would need too many tests, or more than `most_shares` entries.
  using InCells = std::vector<std::vector<std::uint32_t>>;
  [[nodiscard]] std::optional<InCells> sort_into(const Grid& grid, const std::vector<std::uint32_t>& triangles,
                                                 const std::vector<Box>& bounds, std::size_t most_shares) const;
  // Makes the cell for these triangles, all of which overlap the box.
  [[nodiscard]] Cell divide(const Box& box, const std::vector<std::uint32_t>& triangles, const std::vector<Box>& bounds, int depth);

  std::array<int, 2> axes_{0, 1};
  double least_width_ = 0.0;
  std::size_t shares_left_ = 0;   // entries of triangles in cells that are still allowed, beyond one each
  std::vector<Weights> weights_;  // by triangle
  std::vector<Grid> grids_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> items_;  // triangles, by cell
  Cell root_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/plane_grid.cpp>
#endif
