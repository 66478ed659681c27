// SPDX-License-Identifier: MIT
#pragma once

// A flat disk: a surface without inside, whose front is the side that its normal points to; its back is black. One sheet.
//
// Intersection: from the point of the line nearest to the centre (a line that stays a radius away misses) to the plane; then the distance
// from the centre decides. With D the distance of the ray's origin from the centre and c the cosine between line and normal, the
// intersection is known to 16 u (D + r) / c. A line in the disk's own plane does not meet it.
//
// Approximation: the regular polygon of n corners with the area of the disk, so that a lamp keeps its power. Its corners lie outside the
// rim by a third of the chord error, the midpoints of its edges inside by two thirds.

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Disk final : public Object {
 public:
  // Refuses non-finite or huge coordinates, a zero normal, and a radius that is not positive or is negligible beside the coordinates.
  static Made<Disk> make(const glm::dvec3& centre, const glm::dvec3& normal, double radius);

  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] bool exact() const override { return false; }
  [[nodiscard]] bool solid() const override { return false; }

  [[nodiscard]] Box bounds() const override;

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override { compiler.disk(centre_, frame_.into(radius_, radius_)); }

  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override {
    return {p - glm::dot(p - centre_, frame_.w) * frame_.w, frame_.w};
  }

  // The number of corners is a multiple of 4 between 8 and 1024; the back is a face of brep::no_sheet.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  Disk(const glm::dvec3& centre, const glm::dvec3& normal, double radius) : centre_(centre), frame_(normal), radius_(radius) {}

  glm::dvec3 centre_{0.0};
  AxisFrame frame_;
  double radius_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/disk.cpp>
#endif
