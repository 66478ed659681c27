// SPDX-License-Identifier: MIT
#pragma once

// Triangles of a polygon whose corners lie on the grid, exactly: for faces that are no longer planar there.
//
// The polygon is seen along the axis in which its mean normal is largest; it must look simple, bridges to holes apart. An ear is a corner
// that turns left and has no other corner in its triangle (Meisters 1975). All coordinates are integers of 26 bits.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

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
[[nodiscard]] inline std::optional<std::vector<Ear>> ears(const std::vector<GridCorner>& corners) {
  std::vector<std::size_t> left(corners.size());
  std::vector<Ear> result;
  for (std::size_t i = 0; i < left.size(); ++i) { left[i] = i; }
  const auto is_ear = [&](std::size_t k) {
    const GridCorner &a = corners[left[(k + left.size() - 1) % left.size()]], &b = corners[left[k]],
                     &c = corners[left[(k + 1) % left.size()]];
    if (turn(a, b, c) <= 0) { return false; }
    for (std::size_t i : left) {
      const GridCorner& p = corners[i];
      if (p == a || p == b || p == c) { continue; }
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) { return false; }
    }
    return true;
  };
  for (std::size_t at = 0; left.size() > 3;) {
    std::size_t tried = 0;
    while (tried < left.size() && !is_ear(at % left.size())) { ++at, ++tried; }
    if (tried == left.size()) { return std::nullopt; }
    at %= left.size();
    result.push_back({left[(at + left.size() - 1) % left.size()], left[at]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    ++at;  // not a fan
  }
  if (left.size() < 3 || turn(corners[left[0]], corners[left[1]], corners[left[2]]) <= 0) { return std::nullopt; }
  return result;
}

}  // namespace brep::csg::detail
