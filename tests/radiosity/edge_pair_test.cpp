// SPDX-License-Identifier: MIT

// Laws of the integral of ln r over two edges: its error and its cost are bounded whatever the edges, and polygons with rounded coordinates
// exchange what exact ones do.

#include <cmath>
#include <random>

#include "catch.hpp"

#include <radiosity/exchange/edge_pair.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace edge_laws {  // test files are compiled together

using radiosity::detail::Edge;
using radiosity::detail::edge_pair;

// The reference, in long double and by another way: tanh-sinh quadrature (Takahasi and Mori 1974) of the potential, cut where it is
// singular.
using Real = long double;
struct Vector {
  Real x, y, z;
};
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(Real s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vector exact(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

Real potential(const Vector& p, const Vector& start, const Vector& direction, Real length) {
  const Vector d = start - p;
  const Real t0 = dot(d, direction);
  const Real t1 = t0 + length;
  const Vector foot = cross(d, direction);
  const Real h2 = dot(foot, foot);
  const Real h = std::sqrt(h2);
  const auto term = [&](Real t) { return t * t + h2 > 0 ? t / 2 * std::log(t * t + h2) : Real{0}; };
  return term(t1) - term(t0) - length + (h > 0 ? h * (std::atan(t1 / h) - std::atan(t0 / h)) : 0);
}

double reference_integral(const Edge& a, const Edge& b) {
  const Edge& outer = a.length <= b.length ? a : b;
  const Edge& inner = &outer == &a ? b : a;
  Vector u = exact(outer.direction);
  Vector e = exact(inner.direction);
  u = (1 / std::sqrt(dot(u, u))) * u;
  e = (1 / std::sqrt(dot(e, e))) * e;
  const Vector p = exact(outer.start);
  const Vector q = exact(inner.start);
  const Vector w = q - p;
  const Real length = outer.length;
  std::vector<Real> cut{0, length};
  const auto offer = [&](Real s) {
    if (s > 0 && s < length) { cut.push_back(s); }
  };
  offer(dot(w, u));  // beside the ends of the inner edge
  offer(dot(w + Real{inner.length} * e, u));
  const Vector turn = u - dot(u, e) * e;
  if (dot(turn, turn) > 0) { offer(dot(w - dot(w, e) * e, turn) / dot(turn, turn)); }  // beside the other line
  std::sort(cut.begin(), cut.end());
  constexpr Real pi = std::numbers::pi_v<Real>;
  Real total = 0;
  for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
    const Real size = cut[k + 1] - cut[k];
    for (int i = -56; i <= 56; ++i) {  // |t| <= 3.5: to 1e-22 of the ends
      const Real t = i / Real{16};
      const Real x = pi / 2 * std::sinh(t);
      const Real from_end = 1 / (std::exp(2 * std::abs(x)) + 1);
      const Real s = t < 0 ? cut[k] + size * from_end : cut[k + 1] - size * from_end;
      const Real weight = pi / 2 * std::cosh(t) / (std::cosh(x) * std::cosh(x)) / 16;
      total += size / 2 * weight * potential(p + s * u, q, e, inner.length);
    }
  }
  return static_cast<double>(total);
}

struct Random {
  std::mt19937_64 engine;
  double uniform(double a = 0.0, double b = 1.0) { return std::uniform_real_distribution<double>{a, b}(engine); }
  double decades(double least) { return std::pow(least, uniform()); }  // log-uniform in [least, 1]
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
      const double length = glm::length(p);
      if (length <= 1.0 && length > 0.1) { return p / length; }
    }
  }
  // Where on an edge: an end, next to an end on either side, in between.
  double place() {
    const double way = uniform();
    const double beside = 0.3 * decades(1e-8);
    return way < 0.25 ? 0.0 : way < 0.5 ? 1.0 : way < 0.75 ? uniform() : way < 0.875 ? -beside : 1.0 + beside;
  }
  // Two edges at an angle and at a distance of any order of magnitude, 0 among them.
  std::pair<Edge, Edge> edges() {
    const auto length = [&] { return uniform() < 0.7 ? uniform(0.05, 0.5) : 0.5 * decades(1e-6); };
    const double which = uniform();
    const double angle = which < 0.1 ? 0.0 : which < 0.7 ? decades(1e-14) : uniform(0.0, std::numbers::pi);
    const glm::dvec3 e = direction();
    const glm::dvec3 n = glm::normalize(glm::cross(e, direction()));
    const glm::dvec3 m = glm::cross(e, n);
    const glm::dvec3 u = glm::normalize(std::cos(angle) * e + std::sin(angle) * n) * (uniform() < 0.3 ? -1.0 : 1.0);
    const double how_far = uniform();
    const double distance = how_far < 0.3 ? 0.0 : how_far < 0.8 ? 0.5 * decades(1e-14) : uniform(0.0, 0.5);
    const double whither = uniform();
    const glm::dvec3 offset = distance * (whither < 0.6 ? m : whither < 0.8 ? n : direction());
    const glm::dvec3 meeting{0.1, 0.2, 0.3};
    const double a = length();
    const double b = length();
    return {{meeting + offset - place() * a * u, u, a}, {meeting - place() * b * e, e, b}};
  }
};

TEST_CASE("edges at any angle and distance: the integral of ln r is within its tolerance, and asks no more than is stated") {
  const unsigned seed = GENERATE(1u, 2u);
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  for (int trial = 0; trial < 1200; ++trial) {
    const auto [a, b] = random.edges();
    const double right = reference_integral(a, b);
    for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12, 0.0}) {
      int asked = 0;
      const double value = edge_pair(a, b, tolerance, asked);
      const double sine = glm::length(glm::cross(a.direction, b.direction));
      if (!(std::abs(value - right) <= tolerance + 1e-13) || asked > radiosity::detail::most_asked) {
        CAPTURE(trial, tolerance, sine, a.length, b.length, asked, value, right);
        CHECK(std::abs(value - right) <= tolerance + 1e-13);  // lengths below 1, three digits of 16 for the perpendicular at sin phi > .02
        CHECK(asked <= radiosity::detail::most_asked);
      }
    }
  }
}

TEST_CASE("the integral of ln r over two edges is the same from both and with each turned round") {
  Random random{std::mt19937_64{5}};
  INFO("seed 5");
  for (int trial = 0; trial < 500; ++trial) {
    const auto [a, b] = random.edges();
    const Edge turned{a.start + a.length * a.direction, -a.direction, a.length};
    int asked = 0;
    const double value = edge_pair(a, b, 1e-12, asked);
    CHECK(std::abs(edge_pair(b, a, 1e-12, asked) - value) <= 2.2e-12);  // twice the tolerance and the rounding
    CHECK(std::abs(edge_pair(turned, b, 1e-12, asked) - value) <= 2.2e-12);
  }
}

// Furniture: two boxes turned together, which touch, stand apart or overlap in projection; most edges are parallel or perpendicular.
TEST_CASE("polygons with rounded coordinates exchange what the exact ones exchange") {
  Random random{std::mt19937_64{11}};
  INFO("seed 11");
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const glm::dvec3 x = random.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
    const glm::dvec3 z = glm::cross(x, y);
    const auto faces = [&](const glm::dvec3& lo, const glm::dvec3& size) {
      std::vector<radiosity::Polygon> result;
      for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
          const int k = (axis + 1) % 3;
          const int l = (axis + 2) % 3;
          radiosity::Polygon face;
          for (int c = 0; c < 4; ++c) {
            glm::dvec3 p = lo;
            p[axis] += side * size[axis];
            p[k] += (c == 1 || c == 2) ? size[k] : 0.0;
            p[l] += c >= 2 ? size[l] : 0.0;
            face.push_back(p.x * x + p.y * y + p.z * z);
          }
          if (side == 0) { std::reverse(face.begin(), face.end()); }
          result.push_back(face);
        }
      }
      return result;
    };
    const auto size = [&] { return glm::dvec3{random.uniform(0.02, 0.5), random.uniform(0.02, 0.5), random.uniform(0.02, 0.5)}; };
    const glm::dvec3 first = size();
    const std::vector<radiosity::Polygon> a = faces({0.3, 0.2, 0.1}, first);
    const double gap = trial % 3 == 0 ? random.decades(1e-6) : 0.0;
    const std::vector<radiosity::Polygon> b = faces({0.3 + (trial % 2) * 0.1, 0.2 + first.y + gap, 0.1 - (trial % 5) * 0.04}, size());
    for (const radiosity::Polygon& p : a) {
      for (const radiosity::Polygon& q : b) {
        const double right = radiosity::exchange(radiosity::make_patch(p), radiosity::make_patch(q));
        // Faces that touch exchange nothing when exact; a gap of rounding between them lets all of the light through.
        if (right == 0.0 && gap < 1e-3 && glm::dot(radiosity::make_patch(p).normal, radiosity::make_patch(q).normal) < -0.5) { continue; }
        for (const double unit : {1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12}) {
          if (gap > 0.0 && gap < 10.0 * unit) { continue; }
          radiosity::Polygon pr = p;
          radiosity::Polygon qr = q;
          double border = 0.0;
          for (glm::dvec3& c : pr) { c = glm::round(c / unit) * unit; }
          for (glm::dvec3& c : qr) { c = glm::round(c / unit) * unit; }
          for (std::size_t i = 0; i < 4; ++i) { border += glm::length(p[(i + 1) % 4] - p[i]) + glm::length(q[(i + 1) % 4] - q[i]); }
          const radiosity::Patch patch = radiosity::make_patch(pr);
          const radiosity::Patch other = radiosity::make_patch(qr);
          const double value = radiosity::exchange(patch, other);
          // Corners move by less than .87 unit: areas by that times the border, and directions by it over the length of an edge, which
          // changes cosines over the whole area. Both quadratures: 1e-8 of the smaller area, or 2e-5 of the value by the far rules.
          const double bound = 2.0 * unit * border + 2e-8 * std::min(patch.area, other.area) + 4e-5 * right;
          ++compared;
          if (!(std::abs(value - right) <= bound)) {
            CAPTURE(trial, unit, gap, value, right, bound, patch.area, other.area);
            CHECK(std::abs(value - right) <= bound);
          }
        }
      }
    }
  }
  CHECK(compared > 5000);
}

}  // namespace edge_laws
