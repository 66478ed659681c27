// SPDX-License-Identifier: MIT
#include <raycast/objects/cylinder.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Cylinder> Cylinder::make(const glm::dvec3& base, const glm::dvec3& axis, double radius) {
  if (!usable(base) || !usable(axis)) { return "a cylinder's base and axis must be finite (and below 1e60)"; }
  const double magnitude = Box{base, base}.magnitude();
  if (!usable_length(glm::length(axis), magnitude)) { return "a cylinder's axis must have a positive length: it is the height"; }
  if (!usable_length(radius, magnitude)) {
    return "a cylinder's radius must be positive, finite and not vanishing beside its base's coordinates";
  }
  return std::shared_ptr<const Cylinder>(new Cylinder(base, axis, radius));
}

HALFLIGHT_INLINE Box Cylinder::bounds() const {
  Box box;
  frame_.extend(box, base_, radius_);
  frame_.extend(box, base_ + height_ * frame_.w, radius_);
  return box.grown(eps_bounds * box.magnitude());
}

HALFLIGHT_INLINE void Cylinder::spans(const Segment& line, Spans& out) const {
  const glm::dvec3& d = line.direction;
  const double shift = nearest_parameter(line, base_ + 0.5 * height_ * frame_.w);
  const glm::dvec3 f = line.at(shift) - base_;
  const double fz = glm::dot(f, frame_.w), dz = glm::dot(d, frame_.w);
  const glm::dvec3 fp = f - fz * frame_.w, dp = d - dz * frame_.w;
  const double a = glm::dot(dp, dp), parallel = eps_parallel;
  Span span{{-infinity, 0}, {infinity, 0}};
  if (a <= parallel * parallel * glm::dot(d, d)) {
    if (!(glm::dot(fp, fp) < radius_ * radius_)) { return; }
  } else {
    const double k = -glm::dot(fp, dp) / a;
    const double l = glm::length(fp + k * dp);
    if (!(l < radius_)) { return; }
    const double half = std::sqrt((radius_ - l) * (radius_ + l) / a);
    span = Span{{shift + (k - half), 0}, {shift + (k + half), 0}};
  }
  if (clip_between_caps(span, fz, dz, shift, height_, 2)) { out.push(span); }  // drops an empty span
}

HALFLIGHT_INLINE SurfacePoint Cylinder::project(std::uint32_t sheet, const glm::dvec3& p) const {
  const glm::dvec3 f = p - base_;
  const double z = glm::dot(f, frame_.w);
  if (sheet == 1) { return {p - z * frame_.w, -frame_.w}; }
  if (sheet == 2) { return {p + (height_ - z) * frame_.w, frame_.w}; }
  const glm::dvec3 normal = frame_.radial(f);
  return {base_ + z * frame_.w + radius_ * normal, normal};
}

HALFLIGHT_INLINE void Cylinder::approximate(double tolerance, brep::Builder& out) const {
  const int n = circle_points(tolerance / radius_);
  const double width = 2 * radius_ * std::sin(std::numbers::pi / n);
  const int m = rows_along(height_, width, radius_, tolerance);
  std::vector<std::uint32_t> ring;  // row by row, counter-clockwise about the axis
  for (int row = 0; row <= m; ++row) {
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 p = circle_point(i, n);
      ring.push_back(out.vertex(base_ + (height_ * row / m) * frame_.w + radius_ * (p.x * frame_.u + p.y * frame_.v)));
    }
  }
  const auto at = [&](int row, int i) { return ring[static_cast<std::size_t>(row * n + i % n)]; };
  for (int row = 0; row < m; ++row) {
    for (int i = 0; i < n; ++i) { out.face({at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)}, 0); }
  }
  std::vector<std::uint32_t> cap;
  for (int i = n; i-- > 0;) { cap.push_back(at(0, i)); }
  out.face(std::span<const std::uint32_t>(cap), 1);
  cap.clear();
  for (int i = 0; i < n; ++i) { cap.push_back(at(m, i)); }
  out.face(std::span<const std::uint32_t>(cap), 2);
}

}  // namespace raycast
