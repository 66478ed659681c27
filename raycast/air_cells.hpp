// SPDX-License-Identifier: MIT
#pragma once

// Which cells of a grid over a solid lie wholly in the air.
//
// A segment that crosses no face of a solid lies wholly inside it or wholly outside: faces do not say which. One point of it in a cell of
// air does; so the solid's spans, which take many times as long, are asked only about segments that no such point was found of.
//
// A cell is air when no face comes nearer to it than a margin, and the solid's own spans say at its centre, along all three axes, that it
// is outside. Cells that share a side and meet no face are on the same side of the surface, so one of them is asked for all.
//
// Everything is in the coordinates of a compiled scene. The margin covers what a point is rounded by (compiled.hpp).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raycast {

class AirCells {
 public:
  // Of a piece of the surface: its bounds, and the plane that it lies in (height above it); a normal of 0 where that is not known.
  struct Piece {
    std::array<float, 3> lo, hi;
    std::array<float, 4> plane;
  };

  AirCells() = default;

  // A grid of about `wanted` cells over the box. Every piece of the solid's surface must be met, grown by the margin.
  AirCells(const std::array<float, 3>& lo, const std::array<float, 3>& hi, std::size_t wanted);
  void meet(const Piece& piece, float margin);
  // outside(x, y, z) -> is this point outside the solid?
  template <class Outside>
  void finish(Outside&& outside) {
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i] == State::unknown) {
        const std::array<float, 3> p = centre(i);
        spread(i, outside(p[0], p[1], p[2]) ? State::air : State::surface);
      }
    }
  }

  // Is this point known to be in the air? False says nothing.
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
  enum class State : std::uint8_t { unknown, surface, air };  // surface: or inside

  [[nodiscard]] std::array<float, 3> centre(std::uint32_t cell) const;
  // Gives the cell, and all that can be reached from it through unknown cells, this state.
  void spread(std::uint32_t from, State state);
  // The cells of a row along an axis that meet [lo, hi], as a half-open range.
  [[nodiscard]] std::array<std::uint32_t, 2> range(std::size_t axis, float lo, float hi) const;

  std::array<float, 3> lo_{}, cell_{}, per_cell_{};
  std::array<std::uint32_t, 3> count_{};
  std::vector<State> cells_;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/air_cells.cpp>
#endif
