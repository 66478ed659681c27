// SPDX-License-Identifier: MIT
#pragma once

// The curve |x|^p + |y|^p = 1 and its gauge A(x, y) = (|x|^p + |y|^p)^(1/p), from which superquadrics are made twice: once around the axis,
// once along the profile. A is homogeneous of degree one; for p >= 1 it is a norm and convex, for p <= 1 it is concave in every quadrant.
//
// All powers are of ratios between 0 and 1, so nothing overflows or vanishes: A is known to 4 u (1 + 1/p) relative for 0.01 <= p <= 2000.

#include "roots.hpp"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace raycast {

class Superellipse {
 public:
  struct Gauge {
    double value, dx, dy;
  };

  explicit Superellipse(double p) : p_(p) {}
  [[nodiscard]] double p() const { return p_; }
  [[nodiscard]] bool convex() const { return p_ >= 1.0; }

  // The gauge of x, y >= 0 and its derivatives; those of a coordinate that is 0 may be infinite (p < 1).
  [[nodiscard]] Gauge operator()(double x, double y) const {
    if (x < y) {
      const Gauge g = (*this)(y, x);
      return {g.value, g.dy, g.dx};
    }
    if (x == 0.0) return {0.0, 1.0, 1.0};
    const double ratio = y / x;
    if (ratio < flat_) return {x, 1.0, 0.0};
    const double power = this->power(ratio), g = root(1.0 + power), dx = g / (1.0 + power);
    return {x * g, dx, dx * (ratio > 0.0 ? power / ratio : p_ > 1.0 ? 0.0 : p_ < 1.0 ? infinity : 1.0)};
  }
  // The gauge of x, y >= 0 and its derivative along (ex, ey), which must not leave the quadrant's side of an axis: at a coordinate 0 it is
  // taken in the direction in which the coordinate grows (or from which it came).
  [[nodiscard]] std::pair<double, double> along(double x, double y, double ex, double ey) const {
    if (x == 0.0 && y == 0.0) return {0.0, std::copysign((*this)(std::abs(ex), std::abs(ey)).value, ex != 0.0 ? ex : ey)};
    const Gauge g = (*this)(x, y);
    return {g.value, (ex == 0.0 ? 0.0 : g.dx * ex) + (ey == 0.0 ? 0.0 : g.dy * ey)};
  }
  // The width of the curve at the height z >= 0, y of |y|^p + z^p = 1 (0 beyond its end), and its derivative.
  [[nodiscard]] Sample width(double z) const {
    if (!(z > 0.0)) return {1.0, p_ > 1.0 ? 0.0 : p_ < 1.0 ? -infinity : -1.0};
    if (!(z < 1.0)) return {0.0, p_ > 1.0 ? -infinity : p_ < 1.0 ? 0.0 : -1.0};
    const double zp = power(z), yp = zp < 0.5 ? 1.0 - zp : rest(z), y = root(yp);
    return {y, -(zp / z) * (y / yp)};  // (z / y)^(p - 1)
  }

  // Point i of n on the curve, n a multiple of 4: equal angles of x = cos^(2/p), y = sin^(2/p) (Barr 1981), which crowd where the curve
  // bends. Exact mirrors in both axes.
  [[nodiscard]] glm::dvec2 point(int i, int n) const {
    const int quarter = n / 4, k = i % quarter;
    double c = k == 0 ? 1.0 : std::cos(2 * std::numbers::pi * k / n), s = k == 0 ? 0.0 : std::sin(2 * std::numbers::pi * k / n);
    if (2 * k == quarter) s = c;
    double x = std::pow(c, 2.0 / p_), y = std::pow(s, 2.0 / p_);
    if (2 * k > quarter) {  // the mirror of an earlier point, bit by bit
      const glm::dvec2 mirror = point(quarter - k, n);
      x = mirror.y, y = mirror.x;
    }
    for (int turn = i / quarter % 4; turn > 0; --turn) x = -std::exchange(y, x);
    return {x, y};
  }
  // The largest distance between the curve, scaled to semi-axes a, b, and the chords of its n points.
  [[nodiscard]] double chord_error(int n, double a, double b) const {
    constexpr int samples = 24;  // an arch is missed by less than 1 % of its height
    double worst = 0.0;
    for (int i = 0; i < n / 4; ++i) {
      const glm::dvec2 from = point(i, n) * glm::dvec2(a, b), to = point(i + 1, n) * glm::dvec2(a, b), chord = to - from;
      const double length = std::hypot(chord.x, chord.y);
      for (int k = 1; k < samples; ++k) {
        const double angle = 2 * std::numbers::pi * (i + static_cast<double>(k) / samples) / n;
        const glm::dvec2 p = glm::dvec2(a * std::pow(std::cos(angle), 2.0 / p_), b * std::pow(std::sin(angle), 2.0 / p_)) - from;
        worst = std::max(worst, std::abs(p.x * chord.y - p.y * chord.x) / length);
      }
    }
    return 1.01 * worst;
  }
  // The smallest multiple of 4 of points, between `least` and 512, whose chord error is within the tolerance.
  [[nodiscard]] int points(double tolerance, double a, double b, int least) const {
    int n = least;
    while (n < 512 && chord_error(n, a, b) > tolerance) n += std::max(4, n / 8 / 4 * 4);
    return std::min(n, 512);
  }

 private:
  [[nodiscard]] double power(double x) const { return p_ == 2.0 ? x * x : p_ == 1.0 ? x : p_ == 4.0 ? (x * x) * (x * x) : std::pow(x, p_); }
  [[nodiscard]] double root(double x) const {
    return p_ == 2.0 ? std::sqrt(x) : p_ == 1.0 ? x : p_ == 4.0 ? std::sqrt(std::sqrt(x)) : std::pow(x, 1.0 / p_);
  }
  // 1 - z^p without cancellation.
  [[nodiscard]] double rest(double z) const {
    return p_ == 2.0 ? (1.0 - z) * (1.0 + z) : p_ == 1.0 ? 1.0 - z : -std::expm1(p_ * std::log(z));
  }

  double p_;
  double flat_ = p_ >= 64.0 ? std::exp2(-64.0 / p_) : 0.0;  // of nearly straight sides: ratios below have a power that is lost beside 1
};

}  // namespace raycast
