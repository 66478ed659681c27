// SPDX-License-Identifier: MIT
#pragma once

// How error falls with cost: the power law  error = factor * cost^exponent  through the points of one method, by least squares
// in log-log. Points whose error is no more than the reference's noise say nothing about the method and are left out.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace study {

struct CostPoint {
  double cost = 0.0;
  double error = 0.0;
  bool limited = false;  // by the noise of the reference: the error is at most this
};

// Can it be drawn on logarithmic axes?
[[nodiscard]] inline bool drawable(const CostPoint& p) {
  return std::isfinite(p.cost) && std::isfinite(p.error) && p.cost > 0.0 && p.error > 0.0;
}

struct PowerLaw {
  double exponent = 0.0;
  double factor = 0.0;
  double deviation = 0.0;  // standard error of the exponent
  std::size_t points = 0;
};

// Nothing with fewer than three points, or when all have the same cost: two points fit every line.
[[nodiscard]] inline std::optional<PowerLaw> fit_power_law(const std::vector<CostPoint>& points) {
  double n = 0.0;
  double mean_x = 0.0;
  double mean_y = 0.0;
  const auto each = [&points](const auto& use) {
    for (const CostPoint& p : points) {
      if (drawable(p) && !p.limited) { use(std::log(p.cost), std::log(p.error)); }
    }
  };
  each([&](double x, double y) { n += 1.0, mean_x += x, mean_y += y; });
  if (n < 3.0) { return std::nullopt; }
  mean_x /= n;
  mean_y /= n;
  double xx = 0.0;
  double xy = 0.0;
  each([&](double x, double y) { xx += (x - mean_x) * (x - mean_x), xy += (x - mean_x) * (y - mean_y); });
  // Costs that differ by less than 1 part in a million have no slope.
  if (!(xx > 1e-12 * n)) { return std::nullopt; }
  PowerLaw law;
  law.exponent = xy / xx;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  law.points = static_cast<std::size_t>(n);
  double rest = 0.0;
  each([&](double x, double y) {
    const double e = y - mean_y - law.exponent * (x - mean_x);
    rest += e * e;
  });
  law.deviation = std::sqrt(rest / (n - 2.0) / xx);
  return law;
}

// The Pareto front: the points that no other point beats. A point is beaten by one that costs no more and errs no more, and less in one of
// the two; of equal points the first stays. Along the front cost rises and error falls, strictly.
//
// Indices of the points on the front, cheapest first. Points that cannot be drawn are never on it.
[[nodiscard]] inline std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (drawable(points[i])) { order.push_back(i); }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || points[i].error < points[front.back()].error) { front.push_back(i); }
  }
  return front;
}

}  // namespace study
