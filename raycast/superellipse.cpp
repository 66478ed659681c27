// SPDX-License-Identifier: MIT
#include <raycast/superellipse.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/vec2.hpp>

#include <brep/inline.hpp>

#include <raycast/roots.hpp>

namespace raycast {

HALFLIGHT_INLINE Superellipse::Gauge Superellipse::operator()(double x, double y) const {
  if (x < y) {
    const Gauge g = (*this)(y, x);
    return {g.value, g.dy, g.dx};
  }
  if (x == 0.0) { return {0.0, 1.0, 1.0}; }
  const double ratio = y / x;
  if (ratio < flat_) { return {x, 1.0, 0.0}; }
  const double power = this->power(ratio), g = root(1.0 + power), dx = g / (1.0 + power);
  return {x * g, dx, dx * (ratio > 0.0 ? power / ratio : p_ > 1.0 ? 0.0 : p_ < 1.0 ? infinity : 1.0)};
}

HALFLIGHT_INLINE std::pair<double, double> Superellipse::along(double x, double y, double ex, double ey) const {
  if (x == 0.0 && y == 0.0) { return {0.0, std::copysign((*this)(std::abs(ex), std::abs(ey)).value, ex != 0.0 ? ex : ey)}; }
  const Gauge g = (*this)(x, y);
  return {g.value, (ex == 0.0 ? 0.0 : g.dx * ex) + (ey == 0.0 ? 0.0 : g.dy * ey)};
}

HALFLIGHT_INLINE Sample Superellipse::width(double z) const {
  if (!(z > 0.0)) { return {1.0, p_ > 1.0 ? 0.0 : p_ < 1.0 ? -infinity : -1.0}; }
  if (!(z < 1.0)) { return {0.0, p_ > 1.0 ? -infinity : p_ < 1.0 ? 0.0 : -1.0}; }
  if (z < flat_) { return {1.0, 0.0}; }
  const double zp = power(z), yp = zp < 0.5 ? 1.0 - zp : rest(z), y = root(yp);
  return {y, -(zp / z) * (y / yp)};  // (z / y)^(p - 1)
}

HALFLIGHT_INLINE glm::dvec2 Superellipse::point(int i, int n) const {
  const int quarter = n / 4, k = i % quarter;
  double c = k == 0 ? 1.0 : std::cos(2 * std::numbers::pi * k / n), s = k == 0 ? 0.0 : std::sin(2 * std::numbers::pi * k / n);
  if (2 * k == quarter) { s = c; }
  double x = std::pow(c, 2.0 / p_), y = std::pow(s, 2.0 / p_);
  if (2 * k > quarter) {  // the mirror image of an earlier point, bit by bit
    const glm::dvec2 mirror = point(quarter - k, n);
    x = mirror.y, y = mirror.x;
  }
  for (int turn = i / quarter % 4; turn > 0; --turn) { x = -std::exchange(y, x); }
  return {x, y};
}

HALFLIGHT_INLINE double Superellipse::chord_error(int n, double a, double b) const {
  constexpr int samples = 24;  // enough to find the height of an arch within 1 %
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

HALFLIGHT_INLINE int Superellipse::points(double tolerance, double a, double b, int least) const {
  int n = least;
  while (n < 512 && chord_error(n, a, b) > tolerance) { n += std::max(4, n / 8 / 4 * 4); }
  return std::min(n, 512);
}

}  // namespace raycast
