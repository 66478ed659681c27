// SPDX-License-Identifier: MIT
#include "apps/euler/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace apps::euler {
namespace {

using Point = glm::dvec2;

// The deviation of all triangles from their rest shapes (the symmetric Dirichlet energy |J|^2 (1 + 1 / det(J)^2), infinite if a triangle
// is turned over) plus the bending of edges. `scale`: length in the disc of the unit of rest shapes.
double energy(const Net& net, double scale, double stiffness, const std::vector<bool>& fixed, const std::vector<Point>& x,
              std::vector<Point>& gradient) {
  std::fill(gradient.begin(), gradient.end(), Point(0.0));
  double sum = 0.0;
  for (const Triangle& t : net.triangles) {
    const auto& [a, b, c] = t.corner;
    const glm::dmat2 j = glm::dmat2(x[b] - x[a], x[c] - x[a]) * t.rest / scale;
    const double det = j[0].x * j[1].y - j[0].y * j[1].x;
    if (!(det > 0)) { return std::numeric_limits<double>::infinity(); }
    const double square = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
    const double inverse = 1.0 / (det * det);
    sum += square * (1.0 + inverse);
    const glm::dmat2 cofactor(j[1].y, -j[1].x, -j[0].y, j[0].x);
    const glm::dmat2 slope = (2.0 * (1.0 + inverse) * j - 2.0 * square * inverse / det * cofactor) * glm::transpose(t.rest) / scale;
    gradient[b] += slope[0];
    gradient[c] += slope[1];
    gradient[a] -= slope[0] + slope[1];
  }
  for (const auto& [a, b, c] : net.bends) {
    const Point bend = (x[a] - 2.0 * x[b] + x[c]) / scale;
    sum += stiffness * glm::dot(bend, bend);
    const Point slope = 2.0 * stiffness / scale * bend;
    gradient[a] += slope;
    gradient[b] -= 2.0 * slope;
    gradient[c] += slope;
  }
  for (std::size_t i = 0; i < net.count; ++i) {
    if (fixed[i]) { gradient[i] = Point(0.0); }
  }
  return sum;
}

double dot(const std::vector<Point>& a, const std::vector<Point>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) { sum += glm::dot(a[i], b[i]); }
  return sum;
}

}  // namespace

bool all_turn_left(const Net& net, const std::vector<Point>& x) {
  return std::all_of(net.triangles.begin(), net.triangles.end(),
                     [&](const Triangle& t) { return twice_area(x[t.corner[0]], x[t.corner[1]], x[t.corner[2]]) > 0; });
}

void unfold(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<Point>& x) {
  // By point: its triangles, and its corner number in each.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> at(net.count);
  for (std::uint32_t t = 0; t < net.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) { at[net.triangles[t].corner[k]].emplace_back(t, k); }
  }
  constexpr int most = 200;
  for (int round = 0; round < most; ++round) {
    double largest = 0.0;  // largest change of log(area) in the round
    for (std::uint32_t i = 0; i < net.count; ++i) {
      if (fixed[i]) { continue; }
      Point slope(0.0);
      glm::dmat2 curvature(0.0);
      for (const auto& [t, k] : at[i]) {
        const auto& corner = net.triangles[t].corner;
        const Point b = x[corner[(k + 1) % 3]] - x[i], c = x[corner[(k + 2) % 3]] - x[i];
        const double det = b.x * c.y - b.y * c.x;
        const Point grow(b.y - c.y, c.x - b.x);  // gradient of det when x[i] moves
        const glm::dmat2& rest = net.triangles[t].rest;
        const auto row = [&](std::uint32_t m) {
          return m == 0   ? -Point(rest[0].x + rest[0].y, rest[1].x + rest[1].y)
                 : m == 1 ? Point(rest[0].x, rest[1].x)
                          : Point(rest[0].y, rest[1].y);
        };
        const Point mine = row(k), next = row((k + 1) % 3), last = row((k + 2) % 3);
        // J = b next^T + c last^T since the three rows sum to zero; moving x[i] by d adds d mine^T.
        slope += 2.0 / (scale * scale) * (b * glm::dot(next, mine) + c * glm::dot(last, mine)) - 2.0 / det * grow;
        const double even = 2.0 / (scale * scale) * glm::dot(mine, mine), steep = 2.0 / (det * det);
        curvature +=
            glm::dmat2(even + steep * grow.x * grow.x, steep * grow.x * grow.y, steep * grow.x * grow.y, even + steep * grow.y * grow.y);
      }
      Point step = -glm::inverse(curvature) * slope;
      for (int halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
        double change = 0.0;
        bool open = true;
        for (const auto& [t, k] : at[i]) {
          const auto& corner = net.triangles[t].corner;
          const Point& b = x[corner[(k + 1) % 3]];
          const Point& c = x[corner[(k + 2) % 3]];
          const double before = twice_area(x[i], b, c), after = twice_area(x[i] + step, b, c);
          open = open && after > 0.2 * before;
          change = std::max(change, std::abs(after / before - 1.0));
        }
        if (!open) { continue; }
        x[i] += step;
        largest = std::max(largest, change);
        break;
      }
    }
    if (largest < 0.05) { break; }
  }
}

void relax(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<Point>& x) {
  constexpr double stiffness = 12.0;
  constexpr std::size_t memory = 8;
  constexpr int most = 300;
  struct Pair {
    std::vector<Point> step, change;
    double product;
  };
  std::vector<Pair> pairs;
  std::vector<Point> gradient(x.size(), Point(0.0)), next_gradient = gradient, direction = gradient, next = x;
  double now = energy(net, scale, stiffness, fixed, x, gradient);
  for (int round = 0; round < most; ++round) {
    direction = gradient;
    std::vector<double> share(pairs.size());
    for (std::size_t k = pairs.size(); k-- > 0;) {
      share[k] = dot(pairs[k].step, direction) / pairs[k].product;
      for (std::size_t i = 0; i < x.size(); ++i) { direction[i] -= share[k] * pairs[k].change[i]; }
    }
    if (!pairs.empty()) {
      const double factor = pairs.back().product / dot(pairs.back().change, pairs.back().change);
      for (Point& d : direction) { d *= factor; }
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double more = share[k] - dot(pairs[k].change, direction) / pairs[k].product;
      for (std::size_t i = 0; i < x.size(); ++i) { direction[i] += more * pairs[k].step[i]; }
    }
    double longest = 0.0;
    for (const Point& d : direction) { longest = std::max(longest, glm::length(d)); }
    const double slope = dot(direction, gradient);
    if (!(slope > 0) || !(longest > 0)) { break; }
    double size = std::min(1.0, 0.5 * scale / longest), value = 0.0;
    int halvings = 0;
    for (;; ++halvings) {
      for (std::size_t i = 0; i < x.size(); ++i) { next[i] = x[i] - size * direction[i]; }
      value = energy(net, scale, stiffness, fixed, next, next_gradient);
      if (value <= now - 1e-4 * size * slope || halvings == 40) { break; }
      size *= 0.5;
    }
    if (halvings == 40) { break; }
    Pair pair{next, next_gradient, 0.0};
    for (std::size_t i = 0; i < x.size(); ++i) {
      pair.step[i] -= x[i];
      pair.change[i] -= gradient[i];
    }
    pair.product = dot(pair.step, pair.change);
    const bool done = now - value < 1e-7 * now;
    x.swap(next);
    gradient.swap(next_gradient);
    now = value;
    if (done) { break; }
    if (pair.product > 0) {
      if (pairs.size() == memory) { pairs.erase(pairs.begin()); }
      pairs.push_back(std::move(pair));
    }
  }
}

}  // namespace apps::euler
