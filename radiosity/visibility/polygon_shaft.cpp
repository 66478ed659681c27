// SPDX-License-Identifier: MIT
#include <radiosity/visibility/polygon_shaft.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

HALFLIGHT_INLINE Shaft::Shaft(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack) : slack_{slack} {
  for (const glm::dvec3& x : p) { box_.extend(x); }
  for (const glm::dvec3& x : q) { box_.extend(x); }
  support(p, q);
  support(q, p);
}

HALFLIGHT_INLINE bool Shaft::misses(std::span<const glm::dvec3> corners) const {
  raycast::Box box;
  for (const glm::dvec3& x : corners) { box.extend(x); }
  for (int k = 0; k < 3; ++k) {
    if (box.hi[k] <= box_.lo[k] + slack_ || box.lo[k] >= box_.hi[k] - slack_) {
      // The boxes only touch. For a shaft that is flat along this axis that proves nothing, and the planes decide.
      if (box_.hi[k] - box_.lo[k] > 4.0 * slack_) { return true; }
    }
  }
  return std::any_of(planes_.begin(), planes_.end(), [&](const HalfSpace& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& x) { return plane.height(x) <= slack_; });
  });
}

HALFLIGHT_INLINE bool Shaft::misses(const raycast::Box& box) const {
  std::array<glm::dvec3, 8> corners{};
  for (unsigned c = 0; c < 8; ++c) { corners[c] = box.corner(c); }
  return misses(std::span<const glm::dvec3>{corners});
}

HALFLIGHT_INLINE void Shaft::support(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
  offer({p[0], glm::normalize(vector_area(p))}, p, q);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec3 edge = p[i + 1 < p.size() ? i + 1 : 0] - p[i];
    for (const glm::dvec3& corner : q) {
      const glm::dvec3 normal = glm::cross(edge, corner - p[i]);
      const double length = glm::length(normal);
      if (!(length > 0.0)) { continue; }
      offer({p[i], normal / length}, p, q);
      offer({p[i], -normal / length}, p, q);
    }
  }
}

}  // namespace radiosity
