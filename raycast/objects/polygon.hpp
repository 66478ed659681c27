// SPDX-License-Identifier: MIT
#pragma once

// A planar polygon of any simple shape: a surface without inside. Its corners are counter-clockwise seen from the front; the back is
// black. Spans have length zero, at the parameter where the line passes through.
//
// With D the distance of the ray's origin from the polygon, t |d| is known to 4 u D |d| / |n.d|. The line test of planar.hpp makes
// polygons that share an edge (with equal corner coordinates) watertight. A line in the polygon's own plane does not meet it.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Polygon final : public Object {
 public:
  // For refusals and `rounding` see polygon_fault.
  static Made<Polygon> make(std::vector<glm::dvec3> corners, double rounding = 0.0) {
    if (std::optional<std::string> fault = polygon_fault(corners, rounding)) { return "the polygon " + *fault; }
    return std::shared_ptr<const Polygon>(new Polygon(std::move(corners)));
  }

  [[nodiscard]] Box bounds() const override { return box_; }
  [[nodiscard]] bool convex() const override { return convex_; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] bool solid() const override { return false; }
  [[nodiscard]] double slack() const override { return plane_.slack; }
  [[nodiscard]] std::span<const glm::dvec3> outline() const override { return corners_; }

  void spans(const Segment& line, Spans& out) const override {
    const double along = glm::dot(plane_.normal, line.direction);
    if (along == 0.0 || RayFrame(line).winding(corners_) == 0) { return; }
    const double t = glm::dot(plane_.normal, plane_.point - line.origin) / along;
    out.push(Span{{t, 0}, {t, 0}});
  }

  // The polygon itself, whatever the tolerance, and its back as a face of brep::no_sheet.
  void approximate(double, brep::Builder& out) const override {
    std::vector<std::uint32_t> front;
    for (const glm::dvec3& p : corners_) { front.push_back(out.vertex(p)); }
    out.face(std::span<const std::uint32_t>(front), 0);
    const std::vector<std::uint32_t> back(front.rbegin(), front.rend());
    out.face(std::span<const std::uint32_t>(back), brep::no_sheet);
  }

  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override {
    return {p - glm::dot(p - plane_.point, plane_.normal) * plane_.normal, plane_.normal};
  }

 private:
  explicit Polygon(std::vector<glm::dvec3> corners)
      : corners_(std::move(corners)), plane_(plane_of(corners_)), convex_(brep::is_convex(corners_)) {
    for (const glm::dvec3& p : corners_) { box_.extend(p); }
  }

  std::vector<glm::dvec3> corners_;
  Plane plane_;
  Box box_;
  bool convex_ = false;
};

}  // namespace raycast
