// SPDX-License-Identifier: MIT
#pragma once

// The integer grid of one CSG tree, and the planes of all solids that stand on it.
//
// Everything exact is exact relative to this grid: make_solid snaps the vertices of a leaf to it once, and from then on no operation
// rounds. The spacing is a power of two and the centre a multiple of 2^20 spacings, so a number with few binary digits lies on the grid
// itself. Coordinates in spacings, relative to the centre, have 26 bits: |x| < 2^25. A Grid is a handle: copies name the same grid, and
// only solids of the same grid can be combined. make_solid adds planes to the grid, so two threads must not call it at the same time for
// one grid; the operations only read and may run in parallel.

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <brep/csg/plane.hpp>
#include <brep/finite.hpp>

namespace brep::csg {

class Grid {
 public:
  // The grid for leaves within the box lo ... hi. A flat or empty box, or one that is not finite, gives the unit cube's.
  Grid(const glm::dvec3& lo, const glm::dvec3& hi) : planes_(std::make_shared<PlaneTable>()) {
    const glm::dvec3 half = 0.5 * hi - 0.5 * lo;
    double size = std::max({half.x, half.y, half.z});
    if (!(size > 0x1p-900 && size < 0x1p900)) { size = 1.0; }
    spacing_ = std::exp2(std::ceil(std::log2(size)) - 24.0);
    const glm::dvec3 middle = glm::round((0.5 * lo + 0.5 * hi) / (spacing_ * 0x1p20)) * (spacing_ * 0x1p20);
    if (is_finite(middle)) { centre_ = middle; }
  }

  [[nodiscard]] double spacing() const { return spacing_; }                                         // in the units of the leaves
  [[nodiscard]] const glm::dvec3& centre() const { return centre_; }                                // a point of the grid
  [[nodiscard]] glm::dvec3 to_grid(const glm::dvec3& p) const { return (p - centre_) / spacing_; }  // not rounded
  [[nodiscard]] glm::dvec3 from_grid(const glm::dvec3& p) const { return p * spacing_ + centre_; }
  // Does p, snapped, lie on the grid? Half a unit is kept free, for planes that round outwards.
  [[nodiscard]] bool contains(const glm::dvec3& p) const {
    const glm::dvec3 q = glm::abs(to_grid(p));
    return q.x < 0x1p25 - 1.0 && q.y < 0x1p25 - 1.0 && q.z < 0x1p25 - 1.0;  // false for what is not a number
  }

  [[nodiscard]] PlaneTable& planes() const { return *planes_; }
  friend bool operator==(const Grid& a, const Grid& b) { return a.planes_ == b.planes_; }

 private:
  std::shared_ptr<PlaneTable> planes_;
  double spacing_ = 1.0;
  glm::dvec3 centre_{0.0};
};

}  // namespace brep::csg
