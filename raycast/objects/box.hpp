// SPDX-License-Identifier: MIT
#pragma once

// The axis-aligned box lo..hi (the shape; box.hpp has the bounds). Six sheets: x0 x1 y0 y1 z0 z1.
//
// Intersection by slabs. Each crossing is a rounded difference divided once, so t is exact to 2u relative. For a line that leaves the box
// from a point of one of its faces, the exit is within 2u of that point or behind it.

#include <cstdint>
#include <string_view>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class BoxObject final : public Object {
 public:
  // Refuses non-finite or huge coordinates, and an edge that is not positive or is negligible beside the coordinates.
  static Made<BoxObject> make(const glm::dvec3& lo, const glm::dvec3& hi);

  [[nodiscard]] Box bounds() const override { return box_; }
  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return 6; }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override {
    constexpr std::string_view names[6] = {"x0", "x1", "y0", "y1", "z0", "z1"};
    return names[sheet];
  }

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override;

  void approximate(double, brep::Builder& out) const override;

  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override;

 private:
  explicit BoxObject(const Box& box) : box_(box) {}

  // A line parallel to the slab is inside if its origin is; the bounding planes count as inside.
  static bool clip(std::uint32_t lower, double lo, double hi, double origin, double direction, Span& span);

  Box box_;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/box.cpp>
#endif
