// SPDX-License-Identifier: MIT
#include <raycast/objects/cone.hpp>

#include <algorithm>
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

HALFLIGHT_INLINE Made<Cone> Cone::make(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius) {
  if (!usable(base) || !usable(axis)) { return "a cone's base and axis must be finite (and below 1e60)"; }
  const double magnitude = Box{base, base}.magnitude();
  if (!usable_length(glm::length(axis), magnitude)) { return "a cone's axis must have a positive length: it is the height"; }
  if (!usable_length(base_radius, magnitude)) {
    return "a cone's base radius must be positive, finite and not vanishing beside its base's coordinates (a cone points along its axis)";
  }
  if (top_radius != 0.0 && !usable_length(top_radius, magnitude)) {
    return "a cone's top radius must be 0, or positive, finite and not vanishing beside its base's coordinates";
  }
  return std::shared_ptr<const Cone>(new Cone(base, axis, base_radius, top_radius));
}

HALFLIGHT_INLINE Box Cone::bounds() const {
  Box box;
  frame_.extend(box, base_, radius_);
  frame_.extend(box, base_ + height_ * frame_.w, top_radius_);
  return box.grown(eps_bounds * box.magnitude());
}

HALFLIGHT_INLINE void Cone::spans(const Segment& line, Spans& out) const {
  const double shift = nearest_parameter(line, base_ + 0.5 * height_ * frame_.w);
  const glm::dvec3 f = line.at(shift) - base_;
  const double fz = glm::dot(f, frame_.w), dz = glm::dot(line.direction, frame_.w);
  Span span{{-infinity, 0}, {infinity, 0}};
  if (!side(f - fz * frame_.w, line.direction - dz * frame_.w, radius_ + slope_ * fz, slope_ * dz, glm::length(line.direction), span)) {
    return;
  }
  span.in.t += shift;
  span.out.t += shift;
  if (clip_between_caps(span, fz, dz, shift, height_, pointed() ? 0u : 2u)) { out.push(span); }  // drops an empty span
}

HALFLIGHT_INLINE SurfacePoint Cone::project(std::uint32_t sheet, const glm::dvec3& p) const {
  const glm::dvec3 &w = frame_.w, f = p - base_;
  const double z = glm::dot(f, w);
  if (sheet == 1) { return {p - z * w, -w}; }
  if (sheet == 2) { return {p + (height_ - z) * w, w}; }
  // In the half-plane through the axis and p, the side is the line from (radius, 0) in the direction (slope, 1).
  const double x = glm::length(f - z * w);
  const double foot = (slope_ * (x - radius_) + z) / (1.0 + slope_ * slope_);
  const glm::dvec3 radial = frame_.radial(f);
  const double r = radius_ + slope_ * foot;
  if (r <= eps_parallel * std::max(radius_, top_radius_)) { return {base_ - (radius_ / slope_) * w, slope_ < 0.0 ? w : -w}; }
  return {base_ + foot * w + r * radial, glm::normalize(radial - slope_ * w)};
}

HALFLIGHT_INLINE void Cone::approximate(double tolerance, brep::Builder& out) const {
  const double largest = std::max(radius_, top_radius_);
  const int n = circle_points(tolerance / largest);
  const double width = (radius_ + top_radius_) * std::sin(std::numbers::pi / n);
  const int m = rows_along(std::hypot(height_, radius_ - top_radius_), width, largest, tolerance);
  std::vector<std::uint32_t> ring;  // row by row, counter-clockwise about the axis; an apex is one vertex
  for (int row = 0; row <= m; ++row) {
    const double r = row == m ? top_radius_ : radius_ + (top_radius_ - radius_) * row / m;
    const glm::dvec3 middle = base_ + (height_ * row / m) * frame_.w;
    for (int i = 0; i < (r > 0.0 ? n : 1); ++i) {
      const glm::dvec2 p = circle_point(i, n);
      ring.push_back(out.vertex(middle + r * (p.x * frame_.u + p.y * frame_.v)));
    }
  }
  const auto at = [&](int row, int i) { return row == m && pointed() ? ring.back() : ring[static_cast<std::size_t>(row * n + i % n)]; };
  for (int row = 0; row < m; ++row) {
    for (int i = 0; i < n; ++i) {
      if (row + 1 == m && pointed()) {
        out.face({at(row, i), at(row, i + 1), at(m, 0)}, 0);
      } else {
        out.face({at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)}, 0);
      }
    }
  }
  std::vector<std::uint32_t> cap;
  for (int i = n; i-- > 0;) { cap.push_back(at(0, i)); }
  out.face(std::span<const std::uint32_t>(cap), 1);
  if (pointed()) { return; }
  cap.clear();
  for (int i = 0; i < n; ++i) { cap.push_back(at(m, i)); }
  out.face(std::span<const std::uint32_t>(cap), 2);
}

HALFLIGHT_INLINE Cone::Cone(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius)
    : base_(base),
      frame_(axis),
      height_(glm::length(axis)),
      radius_(base_radius),
      top_radius_(top_radius),
      slope_((top_radius - base_radius) / height_) {}

HALFLIGHT_INLINE bool Cone::side(const glm::dvec3& f, const glm::dvec3& d, double rho, double mu, double length, Span& span) {
  const double fl = glm::length(f), dl = glm::length(d);
  if (dl <= eps_parallel * length) {  // counts as parallel to the axis, see cylinder.hpp
    if (mu == 0.0) { return fl < rho; }
    (mu > 0.0 ? span.in.t : span.out.t) = (fl - rho) / mu;
    return true;
  }
  const double a = (dl - std::abs(mu)) * (dl + std::abs(mu)), b = glm::dot(f, d) - rho * mu, c = (fl - rho) * (fl + rho);
  const double e = glm::length(rho * d - mu * f), x = glm::length(glm::cross(f, d));
  if (a >= 0.0 && !(e > x)) { return false; }
  const double root = std::sqrt(std::max(0.0, (e - x) * (e + x)));
  const double q = b >= 0.0 ? -(b + root) : root - b;
  const double first = q == 0.0 ? 0.0 : q / a, second = q == 0.0 ? 0.0 : c / q;  // a = 0: the first is infinite
  if (a >= 0.0) {
    span.in.t = std::min(first, second);
    span.out.t = std::max(first, second);
  } else if (mu > 0.0) {
    span.in.t = std::max(first, second);
  } else {
    span.out.t = std::min(first, second);
  }
  return true;
}

}  // namespace raycast
