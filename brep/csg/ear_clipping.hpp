// SPDX-License-Identifier: MIT
#pragma once

// Triangles of a polygon whose corners lie on the grid, exactly: for faces that are no longer planar there.
//
// The polygon is seen along the axis in which its mean normal is largest; it must look simple, bridges to holes apart. An ear is a corner
// that turns left and has no other corner in its triangle (Meisters 1975). All coordinates are integers of 26 bits.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace brep::csg::detail {

struct GridCorner {
  std::int64_t u, v;
  friend bool operator==(const GridCorner&, const GridCorner&) = default;
};

// Twice the area of a triangle, positive if counter-clockwise. Below 2^55.
[[nodiscard]] inline std::int64_t turn(const GridCorner& a, const GridCorner& b, const GridCorner& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// A corner that is cut off, and the one that is before it by then.
struct Ear {
  std::size_t before, corner;
};

// The ears of a polygon of n corners in the order in which they are cut off, n - 3 of them. What is left then is a triangle. Nothing:
// there are not enough ears. Time O(n^3) at worst, n^2 as a rule.
[[nodiscard]] std::optional<std::vector<Ear>> ears(const std::vector<GridCorner>& corners);

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/ear_clipping.cpp>
#endif
