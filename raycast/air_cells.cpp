// SPDX-License-Identifier: MIT
#include <raycast/air_cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

namespace raycast {

HALFLIGHT_INLINE AirCells::AirCells(const std::array<float, 3>& lo, const std::array<float, 3>& hi, std::size_t wanted) : lo_(lo) {
  const std::array<float, 3> size{hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
  const float edge = std::cbrt(size[0] * size[1] * size[2] / static_cast<float>(wanted));
  std::size_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    // A flat solid would need too many cells of this edge length, so the number along each axis is limited.
    count_[k] = static_cast<std::uint32_t>(std::clamp(size[k] / edge, 1.0f, std::sqrt(static_cast<float>(wanted))));
    cell_[k] = size[k] / static_cast<float>(count_[k]);
    per_cell_[k] = 1.0f / cell_[k];
    cells *= count_[k];
  }
  cells_.assign(cells, State::unknown);
}

HALFLIGHT_INLINE std::array<std::uint32_t, 2> AirCells::range(std::size_t axis, float lo, float hi) const {
  const auto last = static_cast<float>(count_[axis] - 1);
  const auto cell = [&](float x) { return static_cast<std::uint32_t>(std::clamp((x - lo_[axis]) * per_cell_[axis], 0.0f, last)); };
  return {cell(lo), cell(hi) + 1};
}

// Processes columns of cells along the axis most nearly perpendicular to the plane, because the piece overlaps only a few cells of each.
HALFLIGHT_INLINE void AirCells::meet(const Piece& piece, float margin) {
  const std::array<float, 4>& n = piece.plane;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(n[k]) > std::abs(n[axis])) { axis = k; }
  }
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool known = n[axis] != 0.0f;
  const std::array<std::size_t, 3> stride{1, count_[0], std::size_t{count_[0]} * count_[1]};
  const float slope_u = known ? n[u] / n[axis] : 0.0f, slope_v = known ? n[v] / n[axis] : 0.0f;
  const float half = 0.5f * (std::abs(slope_u) * cell_[u] + std::abs(slope_v) * cell_[v]) + 4.0f * margin;
  const auto columns_u = range(u, piece.lo[u] - margin, piece.hi[u] + margin);
  const auto columns_v = range(v, piece.lo[v] - margin, piece.hi[v] + margin);
  for (std::uint32_t i = columns_u[0]; i < columns_u[1]; ++i) {
    for (std::uint32_t j = columns_v[0]; j < columns_v[1]; ++j) {
      float lo = piece.lo[axis] - margin, hi = piece.hi[axis] + margin;
      if (known) {
        const float x = lo_[u] + (static_cast<float>(i) + 0.5f) * cell_[u], y = lo_[v] + (static_cast<float>(j) + 0.5f) * cell_[v];
        const float middle = -(n[u] * x + n[v] * y + n[3]) / n[axis];
        lo = std::max(lo, middle - half);
        hi = std::min(hi, middle + half);
        if (lo > hi) { continue; }
      }
      const auto met = range(axis, lo, hi);
      for (std::uint32_t k = met[0]; k < met[1]; ++k) { cells_[i * stride[u] + j * stride[v] + k * stride[axis]] = State::surface; }
    }
  }
}

HALFLIGHT_INLINE std::array<float, 3> AirCells::centre(std::uint32_t cell) const {
  std::array<float, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = lo_[k] + (static_cast<float>(cell % count_[k]) + 0.5f) * cell_[k];
    cell /= count_[k];
  }
  return p;
}

HALFLIGHT_INLINE void AirCells::spread(std::uint32_t from, State state) {
  std::vector<std::uint32_t> todo{from};
  cells_[from] = state;
  while (!todo.empty()) {
    const std::uint32_t cell = todo.back();
    todo.pop_back();
    std::uint32_t stride = 1;
    for (const std::uint32_t count : count_) {
      const std::uint32_t place = cell / stride % count;
      for (const std::uint32_t next : {place > 0 ? cell - stride : cell, place + 1 < count ? cell + stride : cell}) {
        if (cells_[next] == State::unknown) {
          cells_[next] = state;
          todo.push_back(next);
        }
      }
      stride *= count;
    }
  }
}

}  // namespace raycast
