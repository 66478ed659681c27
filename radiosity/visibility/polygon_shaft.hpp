// SPDX-License-Identifier: MIT
#pragma once

// Proves in double precision what can stand between two convex polygons, by the planes of their shaft, the convex hull of both.

#include <algorithm>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

// The shaft between two convex polygons that lie above each other's horizon. Both polygons lie on the inner side of all its planes.
class Shaft {
 public:
  Shaft(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack);

  // Is it certain that a convex body with these corners (or this box) meets no segment between the two, except by touching it?
  [[nodiscard]] bool misses(std::span<const glm::dvec3> corners) const;
  [[nodiscard]] bool misses(const raycast::Box& box) const;

 private:
  // Adds planes through an edge of `p` with both polygons on one side, including the plane of `p`.
  void support(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q);
  void offer(const HalfSpace& plane, std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
    const auto inside = [&](const glm::dvec3& x) { return plane.height(x) >= -0.25 * slack_; };
    if (std::all_of(p.begin(), p.end(), inside) && std::all_of(q.begin(), q.end(), inside)) { planes_.push_back(plane); }
  }

  double slack_;
  raycast::Box box_;
  std::vector<HalfSpace> planes_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/polygon_shaft.cpp>
#endif
