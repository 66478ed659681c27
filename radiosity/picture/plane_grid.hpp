// SPDX-License-Identifier: MIT
#pragma once

// Which of the triangles of a plane holds a point: a grid over the plane, and within its cells of many triangles further grids. So a point
// is found in a few steps however many triangles there are, and however unequal in size.
//
// The coordinate along which the plane's normal is longest is left out: barycentric coordinates of the rest are the same.

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
  // Triangles of one plane. Those without an area hold no point.
  explicit PlaneGrid(std::span<const Corners> triangles);

  struct Found {
    std::uint32_t triangle = 0;
    glm::dvec3 weight{0.0};  // barycentric
  };
  // The first triangle that holds a point of the plane, its edges included. Nothing where there is none, or where too many lie close
  // together (slivers around one corner) for a grid to part them: then another search must tell.
  [[nodiscard]] std::optional<Found> find(const glm::dvec3& point) const;

 private:
  // Barycentric coordinates of the second and the third corner as functions of a point: g . (u, v) + g.z.
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
  // A cell is a list of triangles, or one more grid.
  struct Cell {
    std::uint32_t first = 0, count = 0;  // in items_; for a grid its number, and is_grid
  };
  struct Grid {
    glm::dvec2 lo{0.0}, cells_per_length{0.0};
    std::array<std::uint32_t, 2> size{};
    std::uint32_t first_cell = 0;
    // The cell that holds a point, or the nearest.
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
  // A cell, and a little of what is around it.
  [[nodiscard]] static Box box_of(const Grid& grid, std::uint32_t x, std::uint32_t y);
  [[nodiscard]] bool meets(std::uint32_t triangle, const Box& cell) const;
  // The triangles of each cell; nothing where that would take more than so many looks at cells, or shares of triangles in them.
  using InCells = std::vector<std::vector<std::uint32_t>>;
  [[nodiscard]] std::optional<InCells> sort_into(const Grid& grid, const std::vector<std::uint32_t>& triangles,
                                                 const std::vector<Box>& bounds, std::size_t most_shares) const;
  // Makes the cell of these triangles, which all reach into the box.
  [[nodiscard]] Cell divide(const Box& box, const std::vector<std::uint32_t>& triangles, const std::vector<Box>& bounds, int depth);

  std::array<int, 2> axes_{0, 1};
  double least_width_ = 0.0;
  std::size_t shares_left_ = 0;  // of triangles in cells, beyond one each
  std::vector<Weights> weights_;
  std::vector<Grid> grids_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> items_;
  Cell root_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/plane_grid.cpp>
#endif
