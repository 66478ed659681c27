// SPDX-License-Identifier: MIT
#pragma once

// The curve |x|^p + |y|^p = 1 and its gauge A(x, y) = (|x|^p + |y|^p)^(1/p). Superquadrics use it twice: around the axis and along the
// profile. A is homogeneous of degree one; for p >= 1 it is a norm and convex, for p <= 1 it is concave in every quadrant.
//
// All powers are of ratios between 0 and 1, so nothing overflows: the relative error of A is at most 4 u (1 + 1/p) for 0.01 <= p <= 2000.

#include <cmath>
#include <utility>

#include <glm/vec2.hpp>

#include <raycast/roots.hpp>

namespace raycast {

class Superellipse {
 public:
  struct Gauge {
    double value, dx, dy;
  };

  explicit Superellipse(double p) : p_(p) {}
  [[nodiscard]] double p() const { return p_; }
  [[nodiscard]] bool convex() const { return p_ >= 1.0; }

  // The gauge of x, y >= 0 and its derivatives; the derivative for a coordinate that is 0 may be infinite (p < 1).
  [[nodiscard]] Gauge operator()(double x, double y) const;
  // The gauge of x, y >= 0 and its derivative along (ex, ey). At a coordinate of 0 the one-sided derivative into the quadrant is used.
  [[nodiscard]] std::pair<double, double> along(double x, double y, double ex, double ey) const;
  // The width of the curve at the height z >= 0, that is, the y with y^p + z^p = 1 (0 beyond its end), and its derivative.
  [[nodiscard]] Sample width(double z) const;

  // Point i of n on the curve, n a multiple of 4: equal angles in x = cos^(2/p), y = sin^(2/p) (Barr 1981), which are dense where the
  // curve bends. The points are exact mirrors in both axes.
  [[nodiscard]] glm::dvec2 point(int i, int n) const;
  // The largest distance between the curve, scaled to semi-axes a, b, and the chords of its n points.
  [[nodiscard]] double chord_error(int n, double a, double b) const;
  // The smallest multiple of 4 of points, between `least` and 512, whose chord error is within the tolerance.
  [[nodiscard]] int points(double tolerance, double a, double b, int least) const;

 private:
  [[nodiscard]] double power(double x) const { return p_ == 2.0 ? x * x : p_ == 1.0 ? x : p_ == 4.0 ? (x * x) * (x * x) : std::pow(x, p_); }
  [[nodiscard]] double root(double x) const {
    if (halves_ == 0) { return p_ == 4.0 ? std::sqrt(std::sqrt(x)) : std::pow(x, 1.0 / p_); }
    double result = halves_ % 2 == 1 ? std::sqrt(x) : 1.0;
    for (int k = 2; k <= halves_; k += 2) { result *= x; }
    return result;
  }
  // 1 - z^p, computed without cancellation.
  [[nodiscard]] double rest(double z) const {
    return p_ == 2.0 ? (1.0 - z) * (1.0 + z) : p_ == 1.0 ? 1.0 - z : -std::expm1(p_ * std::log(z));
  }

  double p_;
  // 2 / p, if that is an integer of at most 6, for which products are as exact as std::pow; otherwise 0.
  int halves_ = 2.0 / p_ <= 6.0 && 2.0 / p_ == std::floor(2.0 / p_) ? static_cast<int>(2.0 / p_) : 0;
  // For nearly straight sides: ratios below this have a power that is lost in rounding beside 1.
  double flat_ = p_ >= 64.0 ? std::exp2(-64.0 / p_) : 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/superellipse.cpp>
#endif
