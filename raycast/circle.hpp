// SPDX-License-Identifier: MIT
#pragma once

// What round objects share: a frame about an axis, the points of a circle, and how many of them keep a chord error.

#include "object.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raycast {

// A right-handed frame u, v, w of unit vectors; w points along the axis, which is not zero.
struct AxisFrame {
  glm::dvec3 u{0.0}, v{0.0}, w{0.0};

  explicit AxisFrame(const glm::dvec3& axis) : w(glm::normalize(axis)) {
    int smallest = 0;  // the coordinate axis that is most across w
    for (int k = 1; k < 3; ++k)
      if (std::abs(w[k]) < std::abs(w[smallest])) smallest = k;
    glm::dvec3 across{0.0};
    across[smallest] = 1.0;
    v = glm::normalize(glm::cross(w, across));
    u = glm::normalize(glm::cross(v, w));
  }

  // Unit vector across the axis towards the point f (relative to a point of the axis); u for a point on the axis.
  [[nodiscard]] glm::dvec3 radial(const glm::dvec3& f) const {
    const double x = glm::dot(f, u), y = glm::dot(f, v), length = std::hypot(x, y);
    return length > 0.0 ? glm::normalize((x / length) * u + (y / length) * v) : u;
  }

  // The map into the frame, in units of `across` and of `along` the axis.
  [[nodiscard]] glm::dmat3 into(double across, double along) const { return glm::transpose(glm::dmat3(u / across, v / across, w / along)); }

  // Adds to the box the circle of this radius about a point of the axis: a disk of unit normal w reaches r sqrt(1 - w_k^2) along axis k.
  void extend(Box& box, const glm::dvec3& centre, double radius) const {
    glm::dvec3 reach{0.0};
    for (int k = 0; k < 3; ++k) reach[k] = radius * std::sqrt(u[k] * u[k] + v[k] * v[k]);
    box.extend(centre - reach);
    box.extend(centre + reach);
  }
};

// Point i of n on the unit circle, n a multiple of 4. Exact quarter turns of the first quadrant keep opposite points exact mirrors.
[[nodiscard]] inline glm::dvec2 circle_point(int i, int n) {
  const double angle = 2 * std::numbers::pi * (i % (n / 4)) / n;
  double x = std::cos(angle), y = std::sin(angle);
  for (int quarter = i / (n / 4) % 4; quarter > 0; --quarter) x = -std::exchange(y, x);
  return {x, y};
}

// The smallest multiple of 4, between 8 and 1024, of points on a unit circle whose chords are off it by `error` at most.
[[nodiscard]] inline int circle_points(double error) {
  constexpr int most = 1024;
  if (!(error > 0.0)) return most;
  int n = 8;
  while (n < most && 1.0 - std::cos(std::numbers::pi / n) > error) n += 4;
  return n;
}

}  // namespace raycast
