// SPDX-License-Identifier: MIT
#include <radiosity/exchange/edge_pair.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

// Integral of ln sqrt(t^2 + h^2) from t0 to t0 + length.
[[nodiscard]] HALFLIGHT_INLINE double log_potential(double t0, double length, double h) {
  const double t1 = t0 + length;
  const double h2 = h * h;
  const auto term = [](double t, double square) { return square > 0.0 ? 0.5 * t * std::log(square) : 0.0; };
  const double angle = h > 0.0 ? h * std::atan2(h * length, h2 + t0 * t1) : 0.0;
  return term(t1, t1 * t1 + h2) - term(t0, t0 * t0 + h2) - length + angle;
}

// Integral of ln |x - p| over the points x of the edge, by arc length. h is the length of the perpendicular; computing it as the square
// root of d^2 - t^2 would have a rounding error of 1e-8.
[[nodiscard]] HALFLIGHT_INLINE double log_potential(const glm::dvec3& p, const Edge& edge) {
  const glm::dvec3 d = edge.start - p;
  const double t0 = glm::dot(d, edge.direction);
  return log_potential(t0, edge.length, glm::length(d - t0 * edge.direction));
}

// Second antiderivative of ln sqrt(x^2 + h^2): the closed form for two parallel edges at distance h.
[[nodiscard]] HALFLIGHT_INLINE double parallel_potential(double x, double h) {
  const double square = x * x + h * h;
  if (!(square > 0.0)) { return 0.0; }
  const double angle = h > 0.0 ? h * x * std::atan2(x, h) : 0.0;
  return 0.25 * (x * x - h * h) * std::log(square) - 0.75 * x * x + angle;
}

// Six-point Gauss rule over [a, b].
template <class Function>
[[nodiscard]] double gauss6(const Function& f, double a, double b, int& asked) {
  constexpr double x[3] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
  constexpr double w[3] = {0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504};
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) { sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i])); }
  asked += 6;
  return half * sum;
}

// The factor rho^-12 in the error of the six-point rule over [a, b]: rho is the sum of the half-axes of the largest ellipse with foci a
// and b that contains no singular point, in units of half the interval (Trefethen, Is Gauss quadrature better than Clenshaw-Curtis?,
// 2008, theorem 4.5).
[[nodiscard]] HALFLIGHT_INLINE double gauss6_decay(std::span<const std::complex<double>> singular, double a, double b) {
  double axis = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& z : singular) { axis = std::min(axis, (std::abs(z - a) + std::abs(z - b)) / (b - a)); }
  if (!(axis > 1.0)) { return 1.0; }
  const double rho = axis + std::sqrt(axis * axis - 1.0);
  const double cube = 1.0 / (rho * rho * rho);
  return cube * cube * cube * cube;
}

// A function with its singular points, and the error of the six-point rule for it: error(length, rho^-12).
template <class Function, class Error>
struct Integrand {
  const Function& f;
  std::span<const std::complex<double>> singular;
  const Error& error;
};
template <class Function, class Error>
Integrand(const Function&, std::span<const std::complex<double>>, const Error&) -> Integrand<Function, Error>;

// The integral over [a, b], which is halved until the error of each part is at most the tolerance.
template <class Function, class Error>
[[nodiscard]] double graded(const Integrand<Function, Error>& of, double a, double b, double tolerance, int& asked) {
  if (!(of.error(b - a, gauss6_decay(of.singular, a, b)) > tolerance)) { return gauss6(of.f, a, b, asked); }
  const double middle = 0.5 * (a + b);
  return graded(of, a, middle, tolerance, asked) + graded(of, middle, b, tolerance, asked);
}

// Integral of ln sqrt(x^2 + h^2) from 0 to x, without the term -x, which does not depend on h.
[[nodiscard]] HALFLIGHT_INLINE double half_potential(double x, double h) {
  const double square = x * x + h * h;
  return (square > 0.0 ? 0.5 * x * std::log(square) : 0.0) + h * std::atan2(x, h);
}

// Edges at a small angle; `outer` is the shorter one.
[[nodiscard]] HALFLIGHT_INLINE double nearly_parallel(Edge outer, const Edge& inner, double sine, double tolerance, int& asked) {
  if (glm::dot(outer.direction, inner.direction) < 0.0) {
    outer = {outer.start + outer.length * outer.direction, -outer.direction, outer.length};
  }
  // At the point s of the outer edge: x = x0 + s cosine along the inner one, h = |across + s turn|.
  const double cosine = glm::dot(outer.direction, inner.direction);
  const glm::dvec3 d = outer.start - inner.start;
  const double x0 = glm::dot(d, inner.direction);
  const glm::dvec3 across = d - x0 * inner.direction;
  const glm::dvec3 turn = outer.direction - cosine * inner.direction;
  const auto distance = [&](double s) { return glm::length(across + s * turn); };
  // The potential is a sum of two halves, one for each end of the inner edge, of lengths x and inner.length - x. For each half h is taken
  // at the point of the outer edge beside that end, so that the remaining change is 0 where it would jump.
  const double x1 = x0 + outer.length * cosine;
  const double h0 = distance(std::clamp(-x0 / cosine, 0.0, outer.length));
  const double h1 = distance(std::clamp((inner.length - x0) / cosine, 0.0, outer.length));
  const double parallel = (parallel_potential(x1, h0) - parallel_potential(x0, h0) + parallel_potential(inner.length - x0, h1) -
                           parallel_potential(inner.length - x1, h1)) /
                          cosine;
  asked += 4;
  if (0.5 * std::numbers::pi * sine * outer.length * outer.length <= tolerance) { return parallel; }
  const auto change = [&](double s) {
    const double x = x0 + s * cosine;
    const double h = distance(s);
    return half_potential(x, h) - half_potential(x, h0) + half_potential(inner.length - x, h) - half_potential(inner.length - x, h1);
  };
  // Singular points: where r is 0 at an end of the inner edge, and where h is 0.
  const auto end = [&](const glm::dvec3& p) {
    const double s = glm::dot(p - outer.start, outer.direction);
    return std::complex<double>{s, glm::length(outer.start + s * outer.direction - p)};
  };
  const double square = sine * sine;
  const std::array<std::complex<double>, 3> singular{
      end(inner.start), end(inner.start + inner.length * inner.direction),
      std::complex<double>{-glm::dot(across, turn) / square, glm::length(glm::cross(across, turn)) / square}};
  // The rule is exact for linear functions. Near a point where the slope of the change jumps by pi sin(phi), its error is less than a
  // tenth of that times length^2. (On the ellipse the change grows as rho, hence the exponent 11/12.)
  const auto error = [&](double length, double decay) {
    return 0.25 * sine * length * length * std::min(1.0, 25.0 * std::pow(decay, 11.0 / 12.0));
  };
  return parallel + graded(Integrand{change, singular, error}, 0.0, outer.length, tolerance, asked);
}

// Edges at an angle that is not small; `normal` is the cross product of their directions and `sine` its length.
[[nodiscard]] HALFLIGHT_INLINE double oblique(const Edge& outer, const Edge& inner, const glm::dvec3& normal, double sine, double tolerance,
                                              int& asked) {
  const double cosine = glm::dot(outer.direction, inner.direction);
  const glm::dvec3 w = outer.start - inner.start;
  const double s0 = glm::dot(glm::cross(w, inner.direction), normal) / (sine * sine);
  const double t0 = glm::dot(glm::cross(w, outer.direction), normal) / (sine * sine);
  const double s1 = s0 + outer.length;
  const double t1 = t0 + inner.length;
  const double d = std::abs(glm::dot(w, normal)) / sine;
  const auto side = [&](double s, double from, double length) {
    return s * log_potential(from - s * cosine, length, std::sqrt(s * s * sine * sine + d * d));
  };
  const double sides = side(s1, t0, inner.length) - side(s0, t0, inner.length) + side(t1, s0, outer.length) - side(t0, s0, outer.length);
  asked += 4;
  double rest = 0.0;
  const double factor = d * d / sine;
  const double u0 = d > 0.0 ? std::asinh(s0 * sine / d) : 0.0;
  const double u1 = d > 0.0 ? std::asinh(s1 * sine / d) : 0.0;
  if (std::numbers::pi * factor * (u1 - u0) > tolerance) {
    const auto angle = [&](double u) {
      const double h = d * std::cosh(u);
      const double t = t0 - d * std::sinh(u) * cosine / sine;
      return std::atan2(h * inner.length, h * h + t * (t + inner.length));
    };
    // Singular points: r is 0 at an end of the inner edge; sinh(u) has the same value at i pi - u.
    std::array<std::complex<double>, 4> singular;
    for (std::size_t k = 0; k < 2; ++k) {
      const double t = k == 0 ? t0 : t1;
      const std::complex<double> u = std::asinh(std::complex<double>{t * cosine, std::sqrt(d * d + t * t * sine * sine)} * (sine / d));
      singular[k] = u;
      singular[k + 2] = {-u.real(), std::numbers::pi - u.imag()};
    }
    const auto error = [&](double length, double decay) { return factor * length * std::min(1.5, decay); };
    rest = factor * graded(Integrand{angle, singular, error}, u0, u1, tolerance, asked);
  }
  return 0.5 * (sides - outer.length * inner.length + rest);
}

HALFLIGHT_INLINE double edge_pair(const Edge& a, const Edge& b, double tolerance, int& asked) {
  const Edge& outer = a.length <= b.length ? a : b;
  const Edge& inner = &outer == &a ? b : a;
  tolerance = std::max(tolerance, 1e-14);
  const glm::dvec3 normal = glm::cross(outer.direction, inner.direction);
  const double sine = glm::length(normal);
  if (sine < 0.02) { return nearly_parallel(outer, inner, sine, tolerance, asked); }
  // The six-point rule has the error 7e-10 l^2 (l / x)^11 if the twelfth derivative is taken at the middle, for the potential of a
  // collinear edge at the distance x. Over the whole edge it is at most six times as large if x >= l.
  const glm::dvec3 apart = inner.start + 0.5 * inner.length * inner.direction - outer.start - 0.5 * outer.length * outer.direction;
  const double x = glm::length(apart) - 0.5 * inner.length;
  const double l2 = outer.length * outer.length;
  const double ratio = l2 / (x * x);
  if (x >= outer.length && 4e-9 * l2 * ratio * ratio * ratio * ratio * ratio <= tolerance) {
    return gauss6([&](double s) { return log_potential(outer.start + s * outer.direction, inner); }, 0.0, outer.length, asked);
  }
  return oblique(outer, inner, normal, sine, tolerance, asked);
}

}  // namespace detail

}  // namespace radiosity
