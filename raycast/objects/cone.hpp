// SPDX-License-Identifier: MIT
#pragma once

// The solid cone or frustum from a base point along an axis vector whose length is the height; the radius goes linearly from that of the
// base to that of the top, which is 0 for a pointed cone. Sheets side, bottom and, unless pointed, top.
//
// Intersection: from the point of the line nearest to the middle of the axis, with f, d the parts of origin and direction across the
// axis, rho the radius at the origin's height and mu its change along d, the side is met where |f + s d| = rho + s mu:
//      A = d^2 - mu^2,  B = f.d - rho mu,  C = f^2 - rho^2,
//      B^2 - A C = (|rho d - mu f| - |f x d|) (|rho d - mu f| + |f x d|),
// whose factors lose nothing to cancellation (mu = 0 gives the cylinder's r |d| - |f x d|). |f + s d| - rho - s mu is convex in s, so the
// solid of one nappe is one interval: between the roots for A > 0, beyond one of them for A <= 0. The slab between the caps, which holds
// no part of the other nappe, is cut with it: no gap can open at the rim. With L the larger of height and radii, the crossings are known to
// 32 u (D + L) across the surface, and hit or miss is decided rightly when the line passes the surface by more.

#include "../circle.hpp"
#include "../compile.hpp"

#include <vector>

namespace raycast {

class Cone final : public Object {
 public:
  // Refused: non-finite or huge coordinates; a height or base radius that is not positive, or a top radius that is negative, or one of
  // them that vanishes beside the coordinates.
  static Made<Cone> make(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius = 0.0) {
    if (!usable(base) || !usable(axis)) return "a cone's base and axis must be finite (and below 1e60)";
    const double magnitude = Box{base, base}.magnitude();
    if (!usable_length(glm::length(axis), magnitude)) return "a cone's axis must have a positive length: it is the height";
    if (!usable_length(base_radius, magnitude))
      return "a cone's base radius must be positive, finite and not vanishing beside its base's coordinates (a cone points along its axis)";
    if (top_radius != 0.0 && !usable_length(top_radius, magnitude))
      return "a cone's top radius must be 0, or positive, finite and not vanishing beside its base's coordinates";
    return std::shared_ptr<const Cone>(new Cone(base, axis, base_radius, top_radius));
  }

  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return pointed() ? 2 : 3; }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override {
    constexpr std::string_view names[3] = {"side", "bottom", "top"};
    return names[sheet];
  }

  [[nodiscard]] Box bounds() const override {
    Box box;
    frame_.extend(box, base_, radius_);
    frame_.extend(box, base_ + height_ * frame_.w, top_radius_);
    return box.grown(4 * unit_roundoff * box.magnitude());
  }

  void spans(const Segment& line, Spans& out) const override {
    const double shift = nearest_parameter(line, base_ + 0.5 * height_ * frame_.w);
    const glm::dvec3 f = line.at(shift) - base_;
    const double fz = glm::dot(f, frame_.w), dz = glm::dot(line.direction, frame_.w);
    Span span{{-infinity, 0}, {infinity, 0}};
    if (!side(f - fz * frame_.w, line.direction - dz * frame_.w, radius_ + slope_ * fz, slope_ * dz, glm::length(line.direction), span))
      return;
    span.in.t += shift;
    span.out.t += shift;
    if (dz == 0.0) {
      if (!(fz >= 0.0 && fz <= height_)) return;
    } else {
      const Crossing bottom{shift - fz / dz, 1}, top{shift + (height_ - fz) / dz, pointed() ? 0u : 2u};
      const Crossing& in = dz > 0.0 ? bottom : top;
      const Crossing& leave = dz > 0.0 ? top : bottom;
      if (in.t > span.in.t) span.in = in;
      if (leave.t < span.out.t) span.out = leave;
    }
    out.push(span);  // drops an empty span
  }

  void compile(Compiler& compiler) const override {
    const double largest = std::max(radius_, top_radius_);
    compiler.cone(base_, frame_.into(largest, height_), radius_ / largest, (top_radius_ - radius_) / largest);
  }

  // The side goes on beyond the caps up to the apex. The normal at the apex itself points along the axis.
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override {
    const glm::dvec3 &w = frame_.w, f = p - base_;
    const double z = glm::dot(f, w);
    if (sheet == 1) return {p - z * w, -w};
    if (sheet == 2) return {p + (height_ - z) * w, w};
    // In the half-plane through the axis and p, the generator runs from (radius, 0) along (slope, 1).
    const double x = glm::length(f - z * w);
    const double foot = (slope_ * (x - radius_) + z) / (1.0 + slope_ * slope_);
    const glm::dvec3 radial = frame_.radial(f);
    const double r = radius_ + slope_ * foot;
    if (r <= 16 * unit_roundoff * std::max(radius_, top_radius_)) return {base_ - (radius_ / slope_) * w, slope_ < 0.0 ? w : -w};
    return {base_ + foot * w + r * radial, glm::normalize(radial - slope_ * w)};
  }

  // n columns, a multiple of 4 between 8 and 1024, so that the chord error of the larger circle is within the tolerance; between 1 and 64
  // rows that make the quadrilaterals of the side nearly square (triangles at the apex); each cap is one n-gon.
  void approximate(double tolerance, brep::Builder& out) const override {
    const double largest = std::max(radius_, top_radius_);
    const int n = circle_points(tolerance / largest);
    const double width = (radius_ + top_radius_) * std::sin(std::numbers::pi / n);
    const int m = static_cast<int>(std::clamp(std::round(std::hypot(height_, radius_ - top_radius_) / width), 1.0, 64.0));
    std::vector<std::uint32_t> ring;  // row by row, counter-clockwise about the axis; one vertex for an apex
    for (int row = 0; row <= m; ++row) {
      const double r = row == m ? top_radius_ : radius_ + (top_radius_ - radius_) * row / m;
      const glm::dvec3 middle = base_ + (height_ * row / m) * frame_.w;
      for (int i = 0; i < (r > 0.0 ? n : 1); ++i) {
        const glm::dvec2 p = circle_point(i, n);
        ring.push_back(out.vertex(middle + r * (p.x * frame_.u + p.y * frame_.v)));
      }
    }
    const auto at = [&](int row, int i) { return row == m && pointed() ? ring.back() : ring[static_cast<std::size_t>(row * n + i % n)]; };
    for (int row = 0; row < m; ++row)
      for (int i = 0; i < n; ++i)
        if (row + 1 == m && pointed())
          out.face({at(row, i), at(row, i + 1), at(m, 0)}, 0);
        else
          out.face({at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)}, 0);
    std::vector<std::uint32_t> cap;
    for (int i = n; i-- > 0;) cap.push_back(at(0, i));
    out.face(std::span<const std::uint32_t>(cap), 1);
    if (pointed()) return;
    cap.clear();
    for (int i = 0; i < n; ++i) cap.push_back(at(m, i));
    out.face(std::span<const std::uint32_t>(cap), 2);
  }

 private:
  Cone(const glm::dvec3& base, const glm::dvec3& axis, double base_radius, double top_radius)
      : base_(base),
        frame_(axis),
        height_(glm::length(axis)),
        radius_(base_radius),
        top_radius_(top_radius),
        slope_((top_radius - base_radius) / height_) {}

  [[nodiscard]] bool pointed() const { return top_radius_ == 0.0; }

  // Where |f + s d| <= rho + s mu; false: nowhere. f and d are across the axis, `length` is that of the whole direction.
  static bool side(const glm::dvec3& f, const glm::dvec3& d, double rho, double mu, double length, Span& span) {
    const double fl = glm::length(f), dl = glm::length(d);
    if (dl <= 16 * unit_roundoff * length) {  // parallel to the axis, see cylinder.hpp
      if (mu == 0.0) return fl < rho;
      (mu > 0.0 ? span.in.t : span.out.t) = (fl - rho) / mu;
      return true;
    }
    const double a = (dl - std::abs(mu)) * (dl + std::abs(mu)), b = glm::dot(f, d) - rho * mu, c = (fl - rho) * (fl + rho);
    const double e = glm::length(rho * d - mu * f), x = glm::length(glm::cross(f, d));
    if (a >= 0.0 && !(e > x)) return false;
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

  glm::dvec3 base_{0.0};
  AxisFrame frame_;
  double height_ = 0.0, radius_ = 0.0, top_radius_ = 0.0;
  double slope_ = 0.0;  // change of the radius along the axis
};

}  // namespace raycast
