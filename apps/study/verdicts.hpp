// SPDX-License-Identifier: MIT
#pragma once

// How tables and plots judge a run. An error measured below the noise of its reference is known only to be at most that noise; the noise
// is shown instead, and marked.
//
// The dependence of error on cost: the power law  error = factor * cost^exponent  through the points of a method, by least squares in
// log-log. Points whose error does not exceed the reference's noise give no information about the method and are left out.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/study/numbers.hpp"
#include "apps/study/results.hpp"

namespace study {

struct CostPoint {
  double cost = 0.0;
  double error = 0.0;
  bool limited = false;  // is the error limited by the noise of the reference? Then it is at most this value
};

// Can the point be drawn on logarithmic axes?
[[nodiscard]] inline bool drawable(const CostPoint& p) {
  return std::isfinite(p.cost) && std::isfinite(p.error) && p.cost > 0.0 && p.error > 0.0;
}

struct PowerLaw {
  double exponent = 0.0;
  double factor = 0.0;
  double deviation = 0.0;  // standard error of the exponent
  std::size_t points = 0;
};

// Nothing if there are fewer than three points, because a line fits any two, or if all have the same cost.
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
  // Costs that differ by less than one part in a million determine no slope.
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

// The Pareto front: the points that no other point dominates. A point dominates another if it has no larger cost and error, and one of
// them is smaller; of equal points the first is kept. Along the front, cost increases and error decreases strictly.
//
// Returns the indices of the points on the front, sorted by cost. Points that cannot be drawn are never on it.
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

struct KnownError {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN: not measured
  bool limited = false;                                     // limited by noise: the error is at most the value
};

[[nodiscard]] inline KnownError known_error(double measured, double noise) {
  if (!std::isfinite(measured)) { return {}; }
  return measured < noise ? KnownError{noise, true} : KnownError{measured, false};
}

// In per cent: "1.20", "< 0.400", "–" for tables whose head names the unit, "1.20 %" elsewhere.
[[nodiscard]] inline std::string to_number(const KnownError& error) { return (error.limited ? "< " : "") + figure(100.0 * error.value); }
[[nodiscard]] inline std::string to_text(const KnownError& error) { return to_number(error) + (std::isfinite(error.value) ? " %" : ""); }

// The kind of solution whose error is measured.
enum class Stage { leaves, simple, weighted };
inline constexpr std::array<Stage, 3> stages = {Stage::leaves, Stage::simple, Stage::weighted};
[[nodiscard]] inline const char* name(Stage stage) {
  return stage == Stage::leaves ? "constant leaves" : stage == Stage::simple ? "simple" : "weighted";
}
[[nodiscard]] inline const Errors& errors(const Run& run, Stage stage) {
  return stage == Stage::leaves ? run.leaves_error : stage == Stage::simple ? run.simple_error : run.weighted_error;
}

// Is there a complete result, not one that was stopped early?
[[nodiscard]] inline bool credited(const Run& run) { return run.refused.empty() && run.cut_off.empty(); }

// The error by which methods are compared: relative L2 of the cell means, before reconstruction.
[[nodiscard]] inline KnownError main_error(const Run& run, const Reference& reference) {
  return credited(run) ? known_error(run.leaves_error.cells.l2, reference.noise) : KnownError{};
}

enum class Cost { cpu_time, memory, links };
[[nodiscard]] inline double cost_of(const Run& run, Cost cost) {
  if (!credited(run)) { return std::numeric_limits<double>::quiet_NaN(); }
  if (cost == Cost::memory && run.peak_bytes == 0) { return std::numeric_limits<double>::quiet_NaN(); }
  return cost == Cost::cpu_time ? run.cpu_seconds : static_cast<double>(cost == Cost::memory ? run.peak_bytes : run.links);
}

// A dash if the peak is not known.
[[nodiscard]] inline std::string memory_text(const Run& run) { return run.peak_bytes > 0 ? bytes_text(run.peak_bytes) : "–"; }

[[nodiscard]] inline CostPoint point_of(const Run& run, const Reference& reference, Cost cost) {
  const KnownError error = main_error(run, reference);
  return {cost_of(run, cost), error.value, error.limited};
}

// The methods of all scenes, in the order in which the study first names them.
[[nodiscard]] inline std::vector<std::string> method_names(const Study& study) {
  std::vector<std::string> names;
  for (const SceneStudy& scene : study.scenes) {
    for (const Method& m : scene.methods) {
      if (!apps::contains(names, m.name)) { names.push_back(m.name); }
    }
  }
  return names;
}

// One point per run.
[[nodiscard]] inline std::vector<CostPoint> points_of(const Method& method, const Reference& reference, Cost cost) {
  std::vector<CostPoint> points;
  for (const Run& run : method.runs) { points.push_back(point_of(run, reference, cost)); }
  return points;
}

// The runs of all methods that no other run dominates in error and CPU time.
[[nodiscard]] inline std::set<const Run*> on_front(const SceneStudy& scene) {
  std::vector<CostPoint> points;
  std::vector<const Run*> runs;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) {
      points.push_back(point_of(run, scene.reference, Cost::cpu_time));
      runs.push_back(&run);
    }
  }
  std::set<const Run*> front;
  for (const std::size_t i : pareto_front(points)) { front.insert(runs[i]); }
  return front;
}

// The run of a method that takes least CPU time of those whose error is at most `target`.
[[nodiscard]] inline const Run* cheapest_within(const Method& method, const Reference& reference, double target) {
  const Run* best = nullptr;
  for (const Run& run : method.runs) {
    const bool reached = main_error(run, reference).value <= target;  // false for NaN
    if (reached && (best == nullptr || cost_of(run, Cost::cpu_time) < cost_of(*best, Cost::cpu_time))) { best = &run; }
  }
  return best;
}

// The run with the smallest error; of equal ones the cheapest.
[[nodiscard]] inline const Run* most_accurate(const Method& method, const Reference& reference) {
  const Run* best = nullptr;
  for (const Run& run : method.runs) {
    const double error = main_error(run, reference).value;
    if (!std::isfinite(error)) { continue; }
    const double least = best == nullptr ? std::numeric_limits<double>::infinity() : main_error(*best, reference).value;
    if (error < least || (error == least && cost_of(run, Cost::cpu_time) < cost_of(*best, Cost::cpu_time))) { best = &run; }
  }
  return best;
}

// The errors at which methods are compared: of 100 %, 50 %, 20 %, 10 %, ..., up to three, the smallest that any run reaches.
[[nodiscard]] inline std::vector<double> targets(const SceneStudy& scene) {
  std::vector<double> reached;
  for (int decade = 0; decade >= -9; --decade) {
    for (const double k : {1.0, 0.5, 0.2}) {
      const double target = k * std::pow(10.0, decade);
      for (const Method& method : scene.methods) {
        if (cheapest_within(method, scene.reference, target) != nullptr) {
          reached.push_back(target);
          break;
        }
      }
    }
  }
  if (reached.size() > 3) { reached.erase(reached.begin(), reached.end() - 3); }
  return reached;
}

}  // namespace study
