// SPDX-License-Identifier: MIT
#pragma once

// The light vector V(x) of a body (Gershun 1936): for a point x above whose horizon the whole body lies, the form factor is n . V(x),
// whatever the unit normal n of x is.
//
// Three ways to compute it, each faster than the one before: the contour integral over the outline (Lambert 1760), for which
// PossibleOutline keeps the edges that may be on the outline seen from a region; LinearLightVector, for a region far from the body;
// and, for a body that is nearly a sphere (roundness), the formula of a sphere of radius r and centre c,
//   V(x) = r^2 (c - x) / |c - x|^3.

#include <array>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

// Where light vectors are asked for: the points of a sphere or, if `normal` is not 0, of its disk with that normal.
struct PointRegion {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
  glm::dvec3 normal{0.0};

  [[nodiscard]] bool planar() const { return normal != glm::dvec3{0.0}; }
};

// The edges of a part of the facets that may lie on the outline seen from some point of a region.
class PossibleOutline {
 public:
  PossibleOutline(const Facets& facets, const Facets::Part& part, const PointRegion& region);
  // The area of the largest facet that faces some points of the region and not others.
  [[nodiscard]] double largest_turning() const { return largest_turning_; }
  // V(x) of the facets that face x, a point of the region more than `slack` above them. `facing`: scratch memory.
  [[nodiscard]] glm::dvec3 light_vector(const glm::dvec3& x, double slack, std::vector<char>& facing) const;

 private:
  struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
  };
  std::vector<Plane> planes_;
  std::vector<Facets::Edge> edges_;  // left and right: indices into planes_
  double largest_turning_ = 0.0;
};

// V(x) |c - x|^3 of a sphere is linear in x, and the farther away a body is relative to its size, the better this holds for any body. So
// over a region far from the body a linear fit from few values suffices.
class LinearLightVector {
 public:
  // Fits the part's light vector over the region. Nullopt if the error would exceed some 0.2 %. `outline`: of the same region.
  [[nodiscard]] static std::optional<LinearLightVector> fit(const Facets::Part& part, const PossibleOutline& outline,
                                                            const PointRegion& region, double slack, std::vector<char>& facing);
  [[nodiscard]] glm::dvec3 at(const glm::dvec3& x) const;

 private:
  glm::dvec3 body_{0.0}, centre_{0.0};
  glm::dvec3 value_{0.0};                        // V |c - x|^3 at the centre of the region
  std::array<glm::dvec3, 3> axes_{}, slopes_{};  // unit vectors, and the derivative of V |c - x|^3 along each
};

// r^2 of the sphere around the part's centre whose light vector differs from that of the part by at most 0.2 %, at distances from 1.1
// radii of the part on; 0 if there is none.
[[nodiscard]] double roundness(const Facets& facets, const Facets::Part& part);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/light_vector.cpp>
#endif
