// SPDX-License-Identifier: MIT
#pragma once

// Finds the cells of a grid over a solid that lie completely in the air.
//
// A segment that crosses no face of a solid lies completely inside or completely outside; the faces do not tell which. One point of it in
// a cell of air decides. So the solid's spans, which take many times as long, are computed only for segments without such a point.
//
// A cell is air if no face comes nearer to it than a margin, and the solid's spans along all three axes say that its centre is outside.
// Adjacent cells without faces lie on the same side of the surface, so only one of them is tested.
//
// All coordinates are those of a compiled scene. The margin covers the rounding of points (compiled.hpp).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raycast {

class AirCells {
 public:
  // A piece of the surface: its bounds and its plane (as height above it); normal 0 if the plane is not known.
  struct Piece {
    std::array<float, 3> lo, hi;
    std::array<float, 4> plane;
  };

  AirCells() = default;

  // Makes a grid of about `wanted` cells over the box. Then meet() must be called for every piece of the solid's surface, with the margin.
  AirCells(const std::array<float, 3>& lo, const std::array<float, 3>& hi, std::size_t wanted);
  void meet(const Piece& piece, float margin);
  // Classifies the remaining cells. outside(x, y, z): is this point outside the solid?
  template <class Outside>
  void finish(Outside&& outside) {
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i] == State::unknown) {
        const std::array<float, 3> p = centre(i);
        spread(i, outside(p[0], p[1], p[2]) ? State::air : State::surface);
      }
    }
  }

  // Is this point known to be in the air? False means unknown.
  [[nodiscard]] bool contains(float x, float y, float z) const {
    const float at[3] = {(x - lo_[0]) * per_cell_[0], (y - lo_[1]) * per_cell_[1], (z - lo_[2]) * per_cell_[2]};
    std::uint32_t index = 0;
    for (std::size_t k = 3; k-- > 0;) {
      if (!(at[k] >= 0.0f && at[k] < static_cast<float>(count_[k]))) { return false; }
      index = index * count_[k] + static_cast<std::uint32_t>(at[k]);
    }
    return cells_[index] == State::air;
  }
  [[nodiscard]] std::size_t bytes() const { return cells_.capacity() * sizeof(State); }

 private:
  enum class State : std::uint8_t { unknown, surface, air };  // surface: near the surface, or inside

  [[nodiscard]] std::array<float, 3> centre(std::uint32_t cell) const;
  // Sets the state of this cell and of all unknown cells connected with it.
  void spread(std::uint32_t from, State state);
  // The half-open range of cells in a row along this axis that overlap [lo, hi].
  [[nodiscard]] std::array<std::uint32_t, 2> range(std::size_t axis, float lo, float hi) const;

  std::array<float, 3> lo_{}, cell_{}, per_cell_{};
  std::array<std::uint32_t, 3> count_{};
  std::vector<State> cells_;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/air_cells.cpp>
#endif
