// SPDX-License-Identifier: MIT
#include <radiosity/picture/plane_grid.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::uint32_t is_grid = 0xffffffff;  // marks a cell that contains a grid, in place of its count
inline constexpr std::size_t few_triangles = 4;       // cells with so few are not divided
inline constexpr double most_cells = 4096.0;          // of one grid
inline constexpr int most_grids = 8;                  // depth limit: no grid separates many triangles that share a corner
inline constexpr std::size_t most_listed = 64;        // triangles of a cell; larger cells are not searched
inline constexpr std::size_t most_shares = 64;        // entries per triangle in the cells of all grids, on average
inline constexpr std::size_t looks_a_share = 8;       // tests of a triangle with a cell, per entry
inline constexpr double weight_slip = 1e-9;           // a point is in a triangle if no weight is below minus this
inline constexpr double cell_slip = 1e-5;             // relative to its width: a triangle within this distance belongs to a cell
inline constexpr double least_width = 1e-10;          // of a divided cell, relative to the coordinates: cell_slip of it is above rounding

}  // namespace detail

HALFLIGHT_INLINE PlaneGrid::PlaneGrid(std::span<const Corners> triangles) {
  glm::dvec3 normal{0.0};  // normal of the largest triangle, which is least affected by rounding
  for (const Corners& t : triangles) {
    const glm::dvec3 own = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (glm::dot(own, own) > glm::dot(normal, normal)) { normal = own; }
  }
  const glm::dvec3 along = glm::abs(normal);
  const int longest = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
  axes_ = {(longest + 1) % 3, (longest + 2) % 3};
  weights_.resize(triangles.size());
  std::vector<Box> bounds(triangles.size());
  std::vector<std::uint32_t> all;
  Box whole;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const glm::dvec2 a = flattened(triangles[i][0]), b = flattened(triangles[i][1]), c = flattened(triangles[i][2]);
    const glm::dvec2 ab = b - a, ac = c - a;
    const double area = ab.x * ac.y - ab.y * ac.x;  // twice the signed area
    const glm::dvec3 second{ac.y / area, -ac.x / area, (a.y * ac.x - a.x * ac.y) / area};
    const glm::dvec3 third{-ab.y / area, ab.x / area, (a.x * ab.y - a.y * ab.x) / area};
    if (!std::isfinite(second.x + second.y + second.z + third.x + third.y + third.z)) { continue; }
    weights_[i] = {second, third};
    bounds[i] = {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
    whole = all.empty() ? bounds[i] : Box{glm::min(whole.lo, bounds[i].lo), glm::max(whole.hi, bounds[i].hi)};
    all.push_back(i);
  }
  if (all.empty()) { return; }
  const glm::dvec2 most = glm::max(glm::abs(whole.lo), glm::abs(whole.hi));
  least_width_ = detail::least_width * std::max(most.x, most.y);
  shares_left_ = detail::most_shares * all.size();
  root_ = divide(whole, all, bounds, 0);
  grids_.shrink_to_fit();
  cells_.shrink_to_fit();
  items_.shrink_to_fit();
}

// For a triangle whose bounds overlap the cell: they are disjoint if one of its weights is negative in the whole cell.
HALFLIGHT_INLINE bool PlaneGrid::meets(const Weights& w, const Box& cell) {
  const glm::dvec2 half = 0.5 * (cell.hi - cell.lo);
  const glm::dvec3 middle = w.at(0.5 * (cell.lo + cell.hi));
  const auto most = [&](double at, double gu, double gv) { return at + std::abs(gu) * half.x + std::abs(gv) * half.y; };
  return std::min({most(middle.x, w.second.x + w.third.x, w.second.y + w.third.y), most(middle.y, w.second.x, w.second.y),
                   most(middle.z, w.third.x, w.third.y)}) >= -detail::weight_slip;
}

HALFLIGHT_INLINE PlaneGrid::Grid PlaneGrid::grid_over(const Box& box, double cells) {
  const glm::dvec2 extent = box.hi - box.lo;
  const double columns = std::clamp(std::round(std::sqrt(cells * extent.x / extent.y)), 1.0, std::floor(cells));
  const glm::dvec2 size{columns, std::max(1.0, std::round(cells / columns))};
  return {box.lo, size / extent, {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)}, 0};
}

HALFLIGHT_INLINE PlaneGrid::Box PlaneGrid::box_of(const Grid& grid, std::uint32_t x, std::uint32_t y) {
  const glm::dvec2 cell{x, y};
  return {grid.lo + (cell - detail::cell_slip) / grid.cells_per_length, grid.lo + (cell + 1.0 + detail::cell_slip) / grid.cells_per_length};
}

HALFLIGHT_INLINE std::optional<PlaneGrid::InCells> PlaneGrid::sort_into(const Grid& grid, const std::vector<std::uint32_t>& triangles,
                                                                        const std::vector<Box>& bounds, std::size_t most_shares) const {
  InCells in_cells(std::size_t{grid.size[0]} * grid.size[1]);
  std::size_t shares = 0, looks = 0;
  for (const std::uint32_t t : triangles) {
    const auto from = grid.cell_of(bounds[t].lo - detail::cell_slip / grid.cells_per_length);
    const auto to = grid.cell_of(bounds[t].hi + detail::cell_slip / grid.cells_per_length);
    looks += std::size_t{to[0] - from[0] + 1} * (to[1] - from[1] + 1);
    if (shares > most_shares || looks > detail::looks_a_share * most_shares) { return std::nullopt; }
    for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
      for (std::uint32_t x = from[0]; x <= to[0]; ++x) {
        if (!meets(weights_[t], box_of(grid, x, y))) { continue; }
        in_cells[std::size_t{y} * grid.size[0] + x].push_back(t);
        ++shares;
      }
    }
  }
  return shares > most_shares ? std::nullopt : std::optional{std::move(in_cells)};
}

HALFLIGHT_INLINE PlaneGrid::Cell PlaneGrid::divide(const Box& box, const std::vector<std::uint32_t>& triangles,
                                                   const std::vector<Box>& bounds, int depth) {
  const glm::dvec2 extent = box.hi - box.lo;
  const bool divisible =
      triangles.size() > detail::few_triangles && depth < detail::most_grids && std::min(extent.x, extent.y) > least_width_;
  double cells = divisible ? std::min(static_cast<double>(triangles.size()), detail::most_cells) : 1.0;
  for (; cells >= 2.0; cells /= 4.0) {
    Grid grid = grid_over(box, cells);
    const std::size_t count = triangles.size(), more = (depth == 0 ? 3 * count : count) + std::size_t{grid.size[0]} * grid.size[1];
    const std::optional<InCells> in_cells = sort_into(grid, triangles, bounds, count + std::min(more, shares_left_));
    if (!in_cells) { continue; }
    std::size_t shares = 0;
    for (const std::vector<std::uint32_t>& cell : *in_cells) { shares += cell.size(); }
    shares_left_ -= std::min(shares_left_, shares - std::min(shares, count));
    grid.first_cell = static_cast<std::uint32_t>(cells_.size());
    cells_.resize(cells_.size() + in_cells->size());
    const auto number = static_cast<std::uint32_t>(grids_.size());
    grids_.push_back(grid);
    for (std::size_t k = 0; k < in_cells->size(); ++k) {
      const auto x = static_cast<std::uint32_t>(k % grid.size[0]), y = static_cast<std::uint32_t>(k / grid.size[0]);
      const Cell made = divide(box_of(grid, x, y), (*in_cells)[k], bounds, depth + 1);
      cells_[grid.first_cell + k] = made;
    }
    return {number, detail::is_grid};
  }
  if (triangles.size() > detail::most_listed) { return {}; }
  const auto first = static_cast<std::uint32_t>(items_.size());
  items_.insert(items_.end(), triangles.begin(), triangles.end());
  return {first, static_cast<std::uint32_t>(triangles.size())};
}

HALFLIGHT_INLINE std::optional<PlaneGrid::Found> PlaneGrid::find(const glm::dvec3& point) const {
  const glm::dvec2 p = flattened(point);
  Cell cell = root_;
  while (cell.count == detail::is_grid) {
    const Grid& grid = grids_[cell.first];
    const auto [x, y] = grid.cell_of(p);
    cell = cells_[grid.first_cell + std::size_t{y} * grid.size[0] + x];
  }
  for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
    const glm::dvec3 weight = weights_[items_[k]].at(p);
    if (std::min({weight.x, weight.y, weight.z}) >= -detail::weight_slip) { return Found{items_[k], weight}; }
  }
  return std::nullopt;
}

}  // namespace radiosity
