// SPDX-License-Identifier: MIT
#pragma once

// Where an object stands in the world: an affine map, and whether the object is turned inside out.
//
// A room is a solid turned inside out: the air is where the solid was. Its spans are the complement, so a line from within is free until
// it meets the wall, and everything outside the room counts as solid. Its normals point inwards, its mesh is seen from inside.
//
// t needs no care: an affine map keeps the parameters of a line, so rays go into object space by mapping origin and direction, and the
// direction is not normalised. A mirror (negative determinant) is legal: the air side stays the air side.

#include "object.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <optional>

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
[[nodiscard]] inline std::optional<std::string> check(const Placement& placement) {
  const glm::dmat3& m = placement.linear;
  if (!usable(m[0]) || !usable(m[1]) || !usable(m[2]) || !usable(placement.translation))
    return "the placement is not finite (or beyond 1e60)";
  double product = 1.0;
  for (int k = 0; k < 3; ++k) product *= glm::length(m[k]);
  if (!(product > 1e-180) || !(std::abs(glm::determinant(m)) > 1e-12 * product))
    return "the placement flattens the object: its determinant is zero";
  return std::nullopt;
}
[[nodiscard]] inline std::optional<std::string> check(const Object& object, const Placement& placement) {
  if (placement.inside && !object.solid()) return "only a solid can be turned inside out: this is a surface without inside";
  return check(placement);
}

// The largest factor by which the map stretches a length, from above and at most 0.2 % too large: trace((L^T L)^512)^(1/512) lies
// between the largest eigenvalue of L^T L and 3^(1/512) times it.
[[nodiscard]] inline double stretch(const glm::dmat3& linear) {
  glm::dmat3 power = glm::transpose(linear) * linear;
  double log_scale = 0.0, exponent = 1.0;
  for (int i = 0; i <= 9; ++i) {
    const double trace = power[0][0] + power[1][1] + power[2][2];
    log_scale += std::log(trace) * exponent;
    if (i == 9) break;
    power = power / trace;
    power = power * power;
    exponent *= 0.5;
  }
  return std::exp(0.5 * log_scale);
}

// An object in the world. It answers what Object answers, in world coordinates; cheap to copy.
class PlacedObject {
 public:
  // Requires object != nullptr and !check(*object, placement).
  explicit PlacedObject(std::shared_ptr<const Object> object, const Placement& placement = {})
      : object_(std::move(object)), placement_(placement), identity_(placement.identity()) {
    if (!identity_) {
      inverse_ = glm::inverse(placement_.linear);
      normal_map_ = glm::transpose(inverse_);
      stretch_ = stretch(placement_.linear);
    }
    if (const std::span<const glm::dvec3> corners = object_->outline(); !corners.empty())
      for (const glm::dvec3& p : corners) bounds_.extend(to_world(p));
    else
      bounds_ = world_box(object_->bounds());
  }

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
    if (placement_.inside) out.complement();
  }
  void spans_of_segment(const Segment& segment, Spans& out) const {
    if (placement_.inside) return spans(segment, out);
    object_->spans_of_segment(to_object(segment), out);
  }

  // Of the body, without the part of a room that is outside it.
  [[nodiscard]] bool passes_once(const Segment& line) const { return object_->passes_once(to_object(line)); }

  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const { return object_->crossing(to_object(line), face); }
  [[nodiscard]] bool enters(const Segment& line, std::uint32_t face) const { return object_->enters(to_object(line), face); }

  // The corners of a single planar polygon in the world, counter-clockwise seen from the air; empty for everything else.
  [[nodiscard]] std::vector<glm::dvec3> outline() const {
    const std::span<const glm::dvec3> corners = object_->outline();
    std::vector<glm::dvec3> result;
    for (const glm::dvec3& p : corners) result.push_back(to_world(p));
    if (mirrored()) std::reverse(result.begin(), result.end());
    return result;
  }

  // The tolerance is a length in the world.
  void approximate(double tolerance, brep::Builder& out) const {
    if (identity_ && !placement_.inside) return object_->approximate(tolerance, out);
    brep::Builder local;
    object_->approximate(tolerance / stretch_, local);
    if (local.vertex_count() == 0) return;
    const std::uint32_t first = out.vertex(to_world(local.position(0)));
    for (std::uint32_t v = 1; v < local.vertex_count(); ++v) out.vertex(to_world(local.position(v)));
    std::vector<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < local.face_count(); ++f) {
      corners.assign(local.corners(f).begin(), local.corners(f).end());
      for (std::uint32_t& v : corners) v += first;
      if (mirrored() != placement_.inside) std::reverse(corners.begin() + 1, corners.end());  // corner 0 stays first
      out.face(std::span<const std::uint32_t>(corners), local.sheet(f));
    }
  }

  // On the sheet always. The nearest point when the map keeps angles (rotation, uniform scale, mirror); otherwise the image of the
  // point that is nearest in object space, which is at most the map's condition number times as far away as the nearest one.
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const {
    SurfacePoint result = object_->project(sheet, identity_ ? p : inverse_ * (p - placement_.translation));
    if (!identity_) result = {to_world(result.position), glm::normalize(normal_map_ * result.normal)};
    if (placement_.inside) result.normal = -result.normal;
    return result;
  }

 private:
  [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& p) const { return identity_ ? p : placement_.linear * p + placement_.translation; }
  [[nodiscard]] Segment to_object(const Segment& line) const {
    return identity_ ? line : Segment{inverse_ * (line.origin - placement_.translation), inverse_ * line.direction};
  }
  [[nodiscard]] bool mirrored() const { return !identity_ && glm::determinant(placement_.linear) < 0.0; }

  // The box around the image of a box, widened by the rounding of the map (8 u of the magnitudes that are added).
  [[nodiscard]] Box world_box(const Box& box) const {
    if (identity_) return box;
    const glm::dvec3 centre = placement_.linear * box.centre() + placement_.translation, half = 0.5 * box.size();
    Box result{centre, centre};
    for (int row = 0; row < 3; ++row) {
      double reach = 0.0, sum = std::abs(placement_.translation[row]);
      for (int column = 0; column < 3; ++column) {
        reach += std::abs(placement_.linear[column][row]) * half[column];
        sum += std::abs(placement_.linear[column][row]) * box.magnitude();
      }
      result.lo[row] -= reach + 8 * unit_roundoff * sum;
      result.hi[row] += reach + 8 * unit_roundoff * sum;
    }
    return result;
  }

  std::shared_ptr<const Object> object_;
  Placement placement_;
  glm::dmat3 inverse_{1.0}, normal_map_{1.0};
  double stretch_ = 1.0;
  Box bounds_;
  bool identity_ = true;
};

}  // namespace raycast
