// SPDX-License-Identifier: MIT
#pragma once

// A flat disk: a surface without inside, seen from the side that its normal points to; the back is black. One sheet.
//
// Intersection: from the point of the line nearest to the centre (a line that stays a radius away misses) to the plane, then the
// distance from the centre. With D the distance of the ray's origin and c the cosine between line and normal, the point where the line
// passes is known to 16 u (D + r) / c; a line in the disk's own plane does not meet it.
//
// Approximation: the polygon of n corners that has the disk's area, so a lamp keeps its power: the corners lie outside the rim by a
// third of the chord error, the middles of the edges inside by two thirds.

#include "../circle.hpp"
#include "../compile.hpp"

#include <vector>

namespace raycast {

class Disk final : public Object {
 public:
  // Refused: non-finite or huge coordinates; a normal of no length; a radius that is not positive or vanishes beside the coordinates.
  static Made<Disk> make(const glm::dvec3& centre, const glm::dvec3& normal, double radius) {
    if (!usable(centre) || !usable(normal)) return "a disk's centre and normal must be finite (and below 1e60)";
    if (!usable_length(glm::length(normal), 0.0)) return "a disk's normal must have a length: it says which side is seen";
    if (!usable_length(radius, Box{centre, centre}.magnitude()))
      return "a disk's radius must be positive, finite and not vanishing beside its centre's coordinates";
    return std::shared_ptr<const Disk>(new Disk(centre, normal, radius));
  }

  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] bool exact() const override { return false; }
  [[nodiscard]] bool solid() const override { return false; }

  [[nodiscard]] Box bounds() const override {
    Box box;
    frame_.extend(box, centre_, radius_);
    return box.grown(4 * unit_roundoff * box.magnitude());
  }

  void spans(const Segment& line, Spans& out) const override {
    const double along = glm::dot(frame_.w, line.direction);
    const double shift = nearest_parameter(line, centre_);
    const glm::dvec3 f = line.at(shift) - centre_;
    if (along == 0.0 || !(glm::dot(f, f) < radius_ * radius_)) return;
    const double height = glm::dot(frame_.w, f), step = -height / along;
    const glm::dvec3 across = (f - height * frame_.w) + step * (line.direction - along * frame_.w);
    if (glm::dot(across, across) < radius_ * radius_) out.push(Span{{shift + step, 0}, {shift + step, 0}});
  }

  void compile(Compiler& compiler) const override { compiler.disk(centre_, frame_.into(radius_, radius_)); }

  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override {
    return {p - glm::dot(p - centre_, frame_.w) * frame_.w, frame_.w};
  }

  // The number of corners is a multiple of 4 between 8 and 1024; its back is a face of brep::no_sheet.
  void approximate(double tolerance, brep::Builder& out) const override {
    const int n = circle_points(tolerance / radius_);
    const double angle = 2 * std::numbers::pi / n, radius = radius_ * std::sqrt(angle / std::sin(angle));
    std::vector<std::uint32_t> front;
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 p = circle_point(i, n);
      front.push_back(out.vertex(centre_ + radius * (p.x * frame_.u + p.y * frame_.v)));
    }
    out.face(std::span<const std::uint32_t>(front), 0);
    const std::vector<std::uint32_t> back(front.rbegin(), front.rend());
    out.face(std::span<const std::uint32_t>(back), brep::no_sheet);
  }

 private:
  Disk(const glm::dvec3& centre, const glm::dvec3& normal, double radius) : centre_(centre), frame_(normal), radius_(radius) {}

  glm::dvec3 centre_{0.0};
  AxisFrame frame_;
  double radius_ = 0.0;
};

}  // namespace raycast
