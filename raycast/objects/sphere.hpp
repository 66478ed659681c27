// SPDX-License-Identifier: MIT
#pragma once

// A sphere. It has one sheet.
//
// Intersection: the origin is moved to the point l of the line nearest to the centre; then r^2 - |l|^2 = (r - |l|)(r + |l|) has no
// cancellation. With D the distance of the origin from the centre, the crossings are known to 32 u D away from the silhouette, and hit or
// miss is decided correctly if | |l| - r | > 8 u D (measured with binary128).
//
// Approximation: a cube with n x n quadrilaterals per side, projected onto the sphere, its grid lines at equal angles. At eight corners
// three quadrilaterals meet; there are no poles and no slivers.

#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Sphere final : public Object {
 public:
  // Refuses non-finite or huge coordinates, and a radius that is not positive or is negligible beside the centre's coordinates.
  static Made<Sphere> make(const glm::dvec3& centre, double radius);

  [[nodiscard]] const glm::dvec3& centre() const { return centre_; }
  [[nodiscard]] double radius() const { return radius_; }

  [[nodiscard]] Box bounds() const override { return Box{centre_ - radius_, centre_ + radius_}; }
  [[nodiscard]] bool convex() const override { return true; }

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override { compiler.sphere(centre_, radius_); }

  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override;

  // n is the smallest number of quadrilaterals along an edge of the cube with a chord error within the tolerance, and at most 256 (a
  // chord error of 2e-5 radii).
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  Sphere(const glm::dvec3& centre, double radius) : centre_(centre), radius_(radius) {}

  // Grid line i of n: the tangent of an angle from -45 to 45 degrees. Odd about the middle, so opposite vertices are exact mirror images.
  static double grid(int i, int n);
  static glm::dvec3 direction(const std::array<int, 3>& at, int n) {
    return glm::normalize(glm::dvec3{grid(at[0], n), grid(at[1], n), grid(at[2], n)});
  }

  // The chord error of the cube sphere of unit radius: the largest distance of the sphere from the plane of a triangle, for both
  // triangulations of every quadrilateral (by symmetry one eighth of one side is enough).
  static double chord_error(int n);
  static int subdivisions(double relative);

  glm::dvec3 centre_{0.0};
  double radius_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/sphere.cpp>
#endif
