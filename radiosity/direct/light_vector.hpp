// SPDX-License-Identifier: MIT
#pragma once

// The light vector of a body (Gershun 1936): seen from a point x over whose horizon all of it lies, the form factor is n . V(x), whatever
// the unit normal n of x is.
//
// Three ways to it, each faster than the one before: the contour integral over the outline (Lambert 1760), of which PossibleOutline keeps
// what the points of a region can see as such; LinearLightVector, for a region that is far from the body; and for what is as round as a
// sphere (roundness) the law of that, with its centre c,
//   V(x) = r^2 (c - x) / |c - x|^3.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

// The edges of a part of facets that are not known to lie between two facets that all points of a region face, or none does.
class PossibleOutline {
 public:
  // The region: a sphere.
  PossibleOutline(const Facets& facets, const Facets::Part& part, const glm::dvec3& centre, double radius);
  // The area of the largest facet that some points of the region face and others do not.
  [[nodiscard]] double largest_turning() const { return largest_turning_; }
  // V(x) of those facets that x, a point of the region, faces: it is higher above them than `slack`. `facing` is memory that is used again.
  [[nodiscard]] glm::dvec3 light_vector(const glm::dvec3& x, double slack, std::vector<char>& facing) const;

 private:
  struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
  };
  std::vector<Plane> planes_;
  std::vector<Facets::Edge> edges_;  // left and right: planes
  double largest_turning_ = 0.0;
};

// V(x) |c - x|^3 of a sphere is linear in x, and the further a body is beside its size, the more it is like that. So over a region that is
// far from the body few values tell all.
class LinearLightVector {
 public:
  // Of the part over a region, a sphere; where `normal` is not 0, over its disk with that normal alone. Nullopt where this would be wrong
  // by more than some 0.2 %. `outline` is that of the region.
  [[nodiscard]] static std::optional<LinearLightVector> fit(const Facets::Part& part, const PossibleOutline& outline,
                                                            const glm::dvec3& centre, double radius, const glm::dvec3& normal, double slack,
                                                            std::vector<char>& facing);
  [[nodiscard]] glm::dvec3 at(const glm::dvec3& x) const;

 private:
  glm::dvec3 body_{0.0}, centre_{0.0};
  glm::dvec3 value_{0.0};                        // V |c - x|^3 at the centre of the region
  std::array<glm::dvec3, 3> axes_{}, slopes_{};  // unit vectors, and its change along them
};

// r^2 of the sphere around the centre of the part whose light vector differs from that of the part by 0.2 % at most, from 1.1 radii of the
// part on; 0 where there is none.
[[nodiscard]] double roundness(const Facets& facets, const Facets::Part& part);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/light_vector.cpp>
#endif
