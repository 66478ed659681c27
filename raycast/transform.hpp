// SPDX-License-Identifier: MIT
#pragma once

// Where an object stands in the world: an affine map, and whether the object is turned inside out.
//
// A room is a solid turned inside out: the air is where the solid was. Its spans are the complement, so a line from within is free until
// it meets the wall, and everything outside the room counts as solid. Its normals point inwards, its mesh is seen from inside.
//
// t needs no care: an affine map keeps the parameters of a line, so rays go into object space by mapping origin and direction, and the
// direction is not normalised. A mirror (negative determinant) is legal: the air side stays the air side.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

struct Placement {
  glm::dmat3 linear{1.0};
  glm::dvec3 translation{0.0};
  bool inside = false;

  [[nodiscard]] bool identity() const { return linear == glm::dmat3(1.0) && translation == glm::dvec3(0.0); }
};

// First `inner`, then `outer`; inside out twice is not inside out.
[[nodiscard]] inline Placement compose(const Placement& outer, const Placement& inner) {
  return {outer.linear * inner.linear, outer.linear * inner.translation + outer.translation, outer.inside != inner.inside};
}

// Why objects cannot be placed so; nothing when they can. Refused: non-finite or huge entries; a map that flattens space, which is taken
// to be so when the determinant is below 1e-12 of the product of the columns' lengths.
[[nodiscard]] std::optional<std::string> check(const Placement& placement);
[[nodiscard]] inline std::optional<std::string> check(const Object& object, const Placement& placement) {
  if (placement.inside && !object.solid()) { return "only a solid can be turned inside out: this is a surface without inside"; }
  return check(placement);
}

// The largest factor by which the map stretches a length, from above and at most 0.2 % too large: trace((L^T L)^512)^(1/512) lies
// between the largest eigenvalue of L^T L and 3^(1/512) times it.
[[nodiscard]] double stretch(const glm::dmat3& linear);

// Is the map a similarity (rotation, mirror, uniform scale), as well as rounding can tell?
[[nodiscard]] bool keeps_angles(const glm::dmat3& linear);

// An object in the world. It answers what Object answers, in world coordinates; cheap to copy.
class PlacedObject {
 public:
  // Requires object != nullptr and !check(*object, placement).
  explicit PlacedObject(std::shared_ptr<const Object> object, const Placement& placement = {});

  [[nodiscard]] const Object& object() const { return *object_; }
  [[nodiscard]] const Placement& placement() const { return placement_; }
  [[nodiscard]] bool inside() const { return placement_.inside; }

  // Of the finite body; the solid part of a room is everything outside it and has no bounds.
  [[nodiscard]] const Box& bounds() const { return bounds_; }

  // Traits. convex() is that of the body: a convex room is the inside of a convex body.
  [[nodiscard]] bool convex() const { return object_->convex(); }
  [[nodiscard]] bool flat() const { return object_->flat(); }
  [[nodiscard]] bool exact() const { return object_->exact(); }
  [[nodiscard]] bool solid() const { return object_->solid(); }
  [[nodiscard]] std::uint32_t sheet_count() const { return object_->sheet_count(); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const { return object_->sheet_name(sheet); }
  [[nodiscard]] double slack() const { return stretch_ * object_->slack(); }

  void spans(const Segment& line, Spans& out) const {
    object_->spans(to_object(line), out);
    if (placement_.inside) { out.complement(); }
  }
  void spans_of_segment(const Segment& segment, Spans& out) const {
    if (placement_.inside) { return spans(segment, out); }
    object_->spans_of_segment(to_object(segment), out);
  }

  // Of the body, without the part of a room that is outside it.
  [[nodiscard]] bool passes_once(const Segment& line) const { return object_->passes_once(to_object(line)); }

  [[nodiscard]] std::uint32_t sheet_of(std::uint32_t face) const { return object_->sheet_of(face); }
  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const { return object_->crossing(to_object(line), face); }
  // -1: the line enters the solid, that around a room too.
  [[nodiscard]] int winding(const Segment& line, std::uint32_t face) const {
    const int w = object_->winding(to_object(line), face);
    return placement_.inside ? -w : w;
  }

  // The corners of a single planar polygon in the world, counter-clockwise seen from the air; empty for everything else.
  [[nodiscard]] std::vector<glm::dvec3> outline() const;

  // The tolerance is a length in the world.
  void approximate(double tolerance, brep::Builder& out) const;

  // On the sheet always. The nearest point when the map keeps angles; otherwise the image of the
  // point that is nearest in object space, which is at most the map's condition number times as far away as the nearest one.
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const;
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const;

 private:
  [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& p) const { return identity_ ? p : placement_.linear * p + placement_.translation; }
  [[nodiscard]] Segment to_object(const Segment& line) const {
    return identity_ ? line : Segment{inverse_ * (line.origin - placement_.translation), inverse_ * line.direction};
  }
  [[nodiscard]] bool mirrored() const { return !identity_ && glm::determinant(placement_.linear) < 0.0; }

  // The box around the image of a box, widened by the rounding of the map (8 u of the magnitudes that are added).
  [[nodiscard]] Box world_box(const Box& box) const;

  std::shared_ptr<const Object> object_;
  Placement placement_;
  glm::dmat3 inverse_{1.0}, normal_map_{1.0};
  double stretch_ = 1.0;
  Box bounds_;
  bool identity_ = true;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/transform.cpp>
#endif
