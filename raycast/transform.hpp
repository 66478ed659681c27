// SPDX-License-Identifier: MIT
#pragma once

// The placement of an object in the world: an affine map, and whether the object is turned inside out.
//
// A room is a solid turned inside out: the air is where the solid was. Its spans are the complement, so a line from inside is free until
// it meets the wall, and everything outside the room counts as solid. Its normals point inwards, and its mesh is seen from inside.
//
// An affine map keeps the parameters of a line, so t needs no conversion: origin and direction are mapped into object space, without
// normalising the direction. A mirror (negative determinant) is allowed; the air side stays the air side.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
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

// First `inner`, then `outer`; inside out applied twice cancels.
[[nodiscard]] inline Placement compose(const Placement& outer, const Placement& inner) {
  return {outer.linear * inner.linear, outer.linear * inner.translation + outer.translation, outer.inside != inner.inside};
}

// The reason why objects cannot be placed by this map; nothing if they can. Refused: non-finite or huge entries; a map that flattens
// space, that is, whose determinant is below 1e-12 of the product of its columns' lengths.
[[nodiscard]] std::optional<std::string> check(const Placement& placement);
[[nodiscard]] inline std::optional<std::string> check(const Object& object, const Placement& placement) {
  if (placement.inside && !object.solid()) { return "only a solid can be turned inside out: this is a surface without inside"; }
  return check(placement);
}

// Upper bound of the factor by which the map stretches a length, at most 0.2 % too large: trace((L^T L)^512)^(1/512) lies between the
// largest eigenvalue of L^T L and 3^(1/512) times it.
[[nodiscard]] double stretch(const glm::dmat3& linear);

// Is the map a similarity (rotation, mirror, uniform scale), within rounding?
[[nodiscard]] bool keeps_angles(const glm::dmat3& linear);

// An object in the world. It has the methods of Object, in world coordinates; cheap to copy.
class PlacedObject {
 public:
  // Requires object != nullptr and !check(*object, placement).
  explicit PlacedObject(std::shared_ptr<const Object> object, const Placement& placement = {});

  [[nodiscard]] const Object& object() const { return *object_; }
  [[nodiscard]] const Placement& placement() const { return placement_; }
  [[nodiscard]] bool inside() const { return placement_.inside; }

  // Bounds of the finite body; the solid part of a room is everything outside it and unbounded.
  [[nodiscard]] const Box& bounds() const { return bounds_; }

  // Traits. convex() refers to the body: a convex room is the inside of a convex body.
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
  void spans_near(const Segment& line, double t0, double t1, Spans& out) const {
    if (placement_.inside) { return spans(line, out); }
    object_->spans_near(to_object(line), t0, t1, out);
  }

  // For the body, without the solid part around a room.
  [[nodiscard]] bool passes_once(const Segment& line) const { return object_->passes_once(to_object(line)); }

  [[nodiscard]] std::uint32_t sheet_of(std::uint32_t face) const { return object_->sheet_of(face); }
  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const { return object_->crossing(to_object(line), face); }
  // -1: the line enters the solid (for a room, the solid around it).
  [[nodiscard]] int winding(const Segment& line, std::uint32_t face) const {
    const int w = object_->winding(to_object(line), face);
    return placement_.inside ? -w : w;
  }

  // The corners of a single planar polygon in world coordinates, counter-clockwise seen from the air; empty for all other objects.
  [[nodiscard]] std::vector<glm::dvec3> outline() const;

  // `tolerance`: a length in world coordinates.
  void approximate(double tolerance, brep::Builder& out) const;

  // Always a point on the sheet. It is the nearest one if the map keeps angles; otherwise it is the image of the nearest point
  // in object space, whose distance is at most the map's condition number times the least distance.
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const;
  // The normal of project(), bit for bit. On a flat object it is the same at every point of a sheet and is not computed again.
  [[nodiscard]] glm::dvec3 normal(std::uint32_t sheet, const glm::dvec3& p) const {
    return normals_ ? (*normals_)[sheet] : project(sheet, p).normal;
  }
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const;

 private:
  [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& p) const { return identity_ ? p : placement_.linear * p + placement_.translation; }
  [[nodiscard]] Segment to_object(const Segment& line) const {
    return identity_ ? line : Segment{inverse_ * (line.origin - placement_.translation), inverse_ * line.direction};
  }
  [[nodiscard]] bool mirrored() const { return !identity_ && glm::determinant(placement_.linear) < 0.0; }

  [[nodiscard]] glm::dvec3 normal_to_world(const glm::dvec3& n) const {
    const glm::dvec3 world = identity_ ? n : glm::normalize(normal_map_ * n);
    return placement_.inside ? -world : world;
  }

  // The box around the image of a box, widened by the rounding of the map (8 u of the magnitudes that are added).
  [[nodiscard]] Box world_box(const Box& box) const;

  std::shared_ptr<const Object> object_;
  Placement placement_;
  glm::dmat3 inverse_{1.0}, normal_map_{1.0};
  double stretch_ = 1.0;
  Box bounds_;
  bool identity_ = true;
  std::shared_ptr<const std::vector<glm::dvec3>> normals_;  // of the sheets of a flat object; null for all others
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/transform.cpp>
#endif
