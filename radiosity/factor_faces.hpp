// SPDX-License-Identifier: MIT
#pragma once

// Form factors between flat faces behind flat faces. What stands between two faces is found by the planes of their shaft (the convex hull
// of both); where nothing does, the exchange is that of exchange.hpp. Else the exact factor from a point to what it sees of the other
// face (shadow.hpp) is integrated over the smaller one: adaptive bisection with 3 x 3 Gauss points, the worst element first. The
// integrand is continuous and piecewise analytic, so some thousand points give six digits.
//
// The integrand has kinks along the edges of shadows, and those are often parallel to the edges of the face. A kink between the border of
// an element and the outermost Gauss point of its parts changes no value that a Gauss rule asks for. So a second rule of the same order, whose
// outermost points lie next to the border, takes part in the estimate of the error.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/exchange.hpp>
#include <radiosity/patch.hpp>
#include <radiosity/shadow.hpp>

namespace radiosity {

// A value and what it is uncertain by.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

// The shaft between two convex polygons that lie above each other's horizon: its planes have both on their inner side.
class Shaft {
 public:
  Shaft(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack) : slack_{slack} {
    for (const glm::dvec3& x : p) { box_.extend(x); }
    for (const glm::dvec3& x : q) { box_.extend(x); }
    support(p, q);
    support(q, p);
  }

  // Is it certain that a convex body with these corners and bounds stands in no segment between the two, except by touching it?
  [[nodiscard]] bool misses(std::span<const glm::dvec3> corners) const {
    raycast::Box box;
    for (const glm::dvec3& x : corners) { box.extend(x); }
    for (int k = 0; k < 3; ++k) {
      if (box.hi[k] <= box_.lo[k] + slack_ || box.lo[k] >= box_.hi[k] - slack_) {
        // Touching: of a flat shaft along an axis this says nothing, the planes decide.
        if (box_.hi[k] - box_.lo[k] > 4.0 * slack_) { return true; }
      }
    }
    return std::any_of(planes_.begin(), planes_.end(), [&](const HalfSpace& plane) {
      return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& x) { return plane.height(x) <= slack_; });
    });
  }
  [[nodiscard]] bool misses(const raycast::Box& box) const {
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c) {
      corners[c] = {c & 1 ? box.hi.x : box.lo.x, c & 2 ? box.hi.y : box.lo.y, c & 4 ? box.hi.z : box.lo.z};
    }
    return misses(std::span<const glm::dvec3>{corners});
  }

 private:
  // Planes through an edge of `p` that have all of both on one side, the plane of `p` among them.
  void support(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
    offer({p[0], glm::normalize(vector_area(p))}, p, q);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec3 edge = p[i + 1 < p.size() ? i + 1 : 0] - p[i];
      for (const glm::dvec3& corner : q) {
        const glm::dvec3 normal = glm::cross(edge, corner - p[i]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) { continue; }
        offer({p[i], normal / length}, p, q);
        offer({p[i], -normal / length}, p, q);
      }
    }
  }
  void offer(const HalfSpace& plane, std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
    const auto inside = [&](const glm::dvec3& x) { return plane.height(x) >= -0.25 * slack_; };
    if (std::all_of(p.begin(), p.end(), inside) && std::all_of(q.begin(), q.end(), inside)) { planes_.push_back(plane); }
  }

  double slack_;
  raycast::Box box_;
  std::vector<HalfSpace> planes_;
};

namespace detail {

// A rule on [0, 1] that is exact for polynomials up to degree 5, with its outermost points .001 from the ends: nodes (1 +- a) / 2 and
// (1 +- b) / 2 with a = .998, b^2 = (a^2 / 3 - 1 / 5) / (a^2 - 1 / 3), and the weights that make it exact. (At the ends themselves, with
// a = 1, it is Lobatto's; but a face that shares an edge with another has no factor to it on the edge.)
inline constexpr std::array<double, 4> wide_x{0.001, 0.276843115326702307, 0.723156884673297692, 0.999};
inline constexpr std::array<double, 4> wide_w{0.084171688397549075, 0.415828311602450924, 0.415828311602450924, 0.084171688397549075};

// Integrates f over a convex polygon until the estimated error is at most `tolerance` or f has been asked `most` times.
template <class Function>
[[nodiscard]] Estimate integrate(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, Function&& f, double tolerance,
                                 std::uint64_t most, std::uint64_t& asked) {
  struct Element {  // the part [u, u + size] x [v, v + size] of quadrilateral `quad`
    std::size_t quad;
    double u, v, size;
    double value;  // by its own nine points
    std::array<double, 4> parts;
    double error;
  };
  struct Quad {
    glm::dvec3 a, b, c, d;
  };
  std::vector<Quad> quads;
  for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
    const bool last = i + 2 >= polygon.size();
    quads.push_back({polygon[0], polygon[i], polygon[i + 1], last ? polygon[i + 1] : polygon[i + 2]});
  }
  const auto apply = [&](std::size_t quad, double u0, double v0, double size, const auto& nodes, const auto& weights) {
    const auto& [a, b, c, d] = quads[quad];
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const double u = u0 + size * nodes[i];
        const double v = v0 + size * nodes[j];
        const glm::dvec3 x = (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c);
        const glm::dvec3 du = (1.0 - v) * (b - a) + v * (c - d);
        const glm::dvec3 dv = (1.0 - u) * (d - a) + u * (c - b);
        sum += weights[i] * weights[j] * glm::dot(glm::cross(du, dv), normal) * f(x);
      }
    }
    asked += nodes.size() * nodes.size();
    return sum * size * size;
  };
  const auto gauss = [&](std::size_t quad, double u, double v, double size) { return apply(quad, u, v, size, gauss3_x, gauss3_w); };
  const auto make = [&](std::size_t quad, double u, double v, double size, double value) {
    const double half = 0.5 * size;
    Element e{quad, u, v, size, value, {}, 0.0};
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      e.parts[k] = gauss(quad, u + (k & 1 ? half : 0.0), v + (k & 2 ? half : 0.0), half);
      sum += e.parts[k];
    }
    e.error = std::abs(sum - value) + std::abs(sum - apply(quad, u, v, size, wide_x, wide_w));
    e.value = sum;
    return e;
  };
  const auto better = [](const Element& x, const Element& y) { return x.error < y.error; };
  std::priority_queue<Element, std::vector<Element>, decltype(better)> queue{better};
  Estimate total;
  // Fine enough at the start for a shadow to be noticed.
  constexpr int start = 4;
  for (std::size_t quad = 0; quad < quads.size(); ++quad) {
    for (int i = 0; i < start * start; ++i) {
      const double u = (i % start) / static_cast<double>(start);
      const double v = (i / start) / static_cast<double>(start);
      const Element e = make(quad, u, v, 1.0 / start, gauss(quad, u, v, 1.0 / start));
      total.value += e.value;
      total.error += e.error;
      queue.push(e);
    }
  }
  while (total.error > tolerance && asked < most) {
    const Element e = queue.top();
    queue.pop();
    total.value -= e.value;
    total.error -= e.error;
    const double half = 0.5 * e.size;
    for (std::size_t k = 0; k < 4; ++k) {
      const Element child = make(e.quad, e.u + (k & 1 ? half : 0.0), e.v + (k & 2 ? half : 0.0), half, e.parts[k]);
      total.value += child.value;
      total.error += child.error;
      queue.push(child);
    }
  }
  return total;
}

// Of two faces that see all of each other: by both contours unless they are far apart or of very different size (exchange.hpp).
[[nodiscard]] inline Estimate clear_exchange(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
  const Patch a = make_patch({p.begin(), p.end()});
  const Patch b = make_patch({q.begin(), q.end()});
  const double distance = glm::length(b.centre - a.centre);
  const double extent = a.radius + b.radius;
  const double ratio = a.radius / b.radius;
  if (extent < 0.1 * distance || ratio < 1e-3 || ratio > 1e3) {
    const double value = exchange(a, b);
    return {value, 1e-5 * value};
  }
  const double scale = extent + distance;
  const double tolerance = 1e-9 * std::min(a.area, b.area) / (scale * scale);
  const double value = std::max(0.0, contour_exchange(p, q, scale, tolerance));
  return {value, 1e-8 * std::min(a.area, b.area)};
}

}  // namespace detail

// The exchange of two convex faces behind blockers, in the squared unit of the coordinates. Those of the blockers that the shaft does not
// meet are left out; `asked` counts the points, and stays where it was when nothing stands in between.
[[nodiscard]] inline Estimate exchange(std::span<const glm::dvec3> p, const glm::dvec3& n, std::span<const glm::dvec3> q,
                                       const glm::dvec3& m, std::span<const Blocker> blockers, double slack, double tolerance,
                                       std::uint64_t most, std::uint64_t& asked) {
  Piece upper_p;
  Piece upper_q;
  Piece lower;
  detail::part(p, {q[0], m}, upper_p, lower);
  detail::part(q, {p[0], n}, upper_q, lower);
  const auto flat = [&](const Piece& piece, const HalfSpace& plane) {
    return std::all_of(piece.begin(), piece.end(), [&](const glm::dvec3& x) { return plane.height(x) <= slack; });
  };
  if (upper_p.empty() || upper_q.empty() || flat(upper_p, {q[0], m}) || flat(upper_q, {p[0], n})) { return {}; }
  const double area_p = glm::length(vector_area(upper_p));
  const double area_q = glm::length(vector_area(upper_q));
  if (!(area_p > slack * slack) || !(area_q > slack * slack)) { return {}; }
  const Shaft shaft{upper_p, upper_q, slack};
  std::vector<Blocker> between;
  for (const Blocker& blocker : blockers) {
    if (!shaft.misses(blocker.contour)) { between.push_back(blocker); }
  }
  if (between.empty()) { return detail::clear_exchange(upper_p, upper_q); }
  const bool over_p = area_p <= area_q;
  ShadowedTarget target{over_p ? upper_q : upper_p, over_p ? m : n, between, slack};
  const glm::dvec3& normal = over_p ? n : m;
  std::uint64_t own = 0;
  const Estimate result = detail::integrate(
      over_p ? upper_p : upper_q, normal, [&](const glm::dvec3& x) { return target.form_factor(x, normal); }, tolerance, most, own);
  asked += own;
  return result;
}

}  // namespace radiosity
