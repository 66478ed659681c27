// SPDX-License-Identifier: MIT
#pragma once

// A solid cylinder. The axis vector starts at the base point; its length is the height. Sheets: side, bottom, top.
//
// Intersection: the origin is moved to the point of the line nearest to the middle of the cylinder. The infinite cylinder (a circle in
// the plane perpendicular to the axis, solved like the sphere) and the slab between the caps give one interval each; the solid is their
// intersection, so there is no gap at the rim. A line whose direction has a component perpendicular to the axis below 16 u of its length
// counts as parallel: over the height it deviates by 16 u of the height, which is within the rounding of the coordinates.

#include <cstdint>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Cylinder final : public Object {
 public:
  // Refuses non-finite or huge coordinates, and a height or radius that is not positive or is negligible beside the coordinates.
  static Made<Cylinder> make(const glm::dvec3& base, const glm::dvec3& axis, double radius);

  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return 3; }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override {
    constexpr std::string_view names[3] = {"side", "bottom", "top"};
    return names[sheet];
  }

  // The bounds of the two cap disks, widened by 4 u of the magnitude.
  [[nodiscard]] Box bounds() const override;

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override { compiler.cylinder(base_, frame_, radius_, height_); }

  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override;

  // n columns, a multiple of 4 between 8 and 1024, so that the chord error r (1 - cos(pi/n)) is within the tolerance; 1 to 64 rows, so
  // that the quadrilaterals of the side are nearly square. Each cap is one n-gon.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  Cylinder(const glm::dvec3& base, const glm::dvec3& axis, double radius)
      : base_(base), frame_(axis), height_(glm::length(axis)), radius_(radius) {}

  glm::dvec3 base_{0.0};
  AxisFrame frame_;
  double height_ = 0.0, radius_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/cylinder.cpp>
#endif
