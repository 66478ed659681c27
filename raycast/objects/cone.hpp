// SPDX-License-Identifier: MIT
#pragma once

// A solid cone or frustum. The axis vector starts at the base point; its length is the height. The radius changes linearly from base to
// top, where it is 0 for a pointed cone. Sheets: side, bottom and, unless pointed, top.
//
// Intersection: the origin is moved to the point of the line nearest to the middle of the axis. Let f, d be the components of origin and
// direction perpendicular to the axis, rho the radius at the origin's height and mu its change along d. The line meets the side where
// |f + s d| = rho + s mu:
//      A = d^2 - mu^2,  B = f.d - rho mu,  C = f^2 - rho^2,
//      B^2 - A C = (|rho d - mu f| - |f x d|) (|rho d - mu f| + |f x d|),
// This product has no cancellation (mu = 0 gives the cylinder's r |d| - |f x d|). |f + s d| - rho - s mu is convex in s, so the line's
// part in the solid of one nappe is one interval: between the roots for A > 0, beyond one of them for A <= 0. It is intersected with the
// slab between the caps, which contains no part of the other nappe, so there is no gap at the rim. With L the largest of height and
// radii, crossings are known to 32 u (D + L) perpendicular to the surface, and hit or miss is decided correctly if the line passes the
// surface at a larger distance.

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Cone final : public Object {
 public:
  // Refuses non-finite or huge coordinates; a height or base radius that is not positive; a negative top radius; and any of these that is
  // negligible beside the coordinates.
  static Made<Cone> make(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius = 0.0);

  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return pointed() ? 2 : 3; }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override {
    constexpr std::string_view names[3] = {"side", "bottom", "top"};
    return names[sheet];
  }

  [[nodiscard]] Box bounds() const override;

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override {
    const double largest = std::max(radius_, top_radius_);
    compiler.cone(base_, frame_.into(largest, height_), radius_ / largest, (top_radius_ - radius_) / largest);
  }

  // The side is extended beyond the caps up to the apex. The normal at the apex points along the axis.
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override;

  // n columns, a multiple of 4 between 8 and 1024, so that the chord error of the larger circle is within the tolerance; 1 to 64 rows, so
  // that the quadrilaterals of the side are nearly square (triangles at the apex). Each cap is one n-gon.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  Cone(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius);

  [[nodiscard]] bool pointed() const { return top_radius_ == 0.0; }

  // The interval with |f + s d| <= rho + s mu; false if it is empty. f and d are perpendicular to the axis, `length` is that of
  // the full direction.
  static bool side(const glm::dvec3& f, const glm::dvec3& d, double rho, double mu, double length, Span& span);

  glm::dvec3 base_{0.0};
  AxisFrame frame_;
  double height_ = 0.0, radius_ = 0.0, top_radius_ = 0.0;
  double slope_ = 0.0;  // change of the radius per unit of length along the axis
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/cone.cpp>
#endif
