// SPDX-License-Identifier: MIT
#pragma once

// What tables and plots say about a run. An error that was measured below the noise of its reference is known only to be at most that
// noise: the noise is given in its place, and marked.

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "apps/study/cost_points.hpp"
#include "apps/study/numbers.hpp"
#include "apps/study/results.hpp"

namespace study {

struct KnownError {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN: not measured
  bool limited = false;                                     // by noise: at most the value
};

[[nodiscard]] inline KnownError known_error(double measured, double noise) {
  if (!std::isfinite(measured)) { return {}; }
  return measured < noise ? KnownError{noise, true} : KnownError{measured, false};
}

// In per cent: "1.20", "< 0.400", "–" in tables that name the unit, "1.20 %" elsewhere.
[[nodiscard]] inline std::string to_number(const KnownError& error) { return (error.limited ? "< " : "") + figure(100.0 * error.value); }
[[nodiscard]] inline std::string to_text(const KnownError& error) { return to_number(error) + (std::isfinite(error.value) ? " %" : ""); }

// What the error is the error of.
enum class Stage { leaves, simple, weighted };
inline constexpr std::array<Stage, 3> stages = {Stage::leaves, Stage::simple, Stage::weighted};
[[nodiscard]] inline const char* name(Stage stage) {
  return stage == Stage::leaves ? "constant leaves" : stage == Stage::simple ? "simple" : "weighted";
}
[[nodiscard]] inline const Errors& errors(const Run& run, Stage stage) {
  return stage == Stage::leaves ? run.leaves_error : stage == Stage::simple ? run.simple_error : run.weighted_error;
}

// Is there a result, and is it what the setting asked for?
[[nodiscard]] inline bool credited(const Run& run) { return run.refused.empty() && run.cut_off.empty(); }

// By which methods are compared: relative L2 of the cell means, before reconstruction.
[[nodiscard]] inline KnownError main_error(const Run& run, const Reference& reference) {
  return credited(run) ? known_error(run.leaves_error.cells.l2, reference.noise) : KnownError{};
}

enum class Cost { cpu_time, memory, links };
[[nodiscard]] inline double cost_of(const Run& run, Cost cost) {
  if (!credited(run)) { return std::numeric_limits<double>::quiet_NaN(); }
  if (cost == Cost::memory && run.peak_bytes == 0) { return std::numeric_limits<double>::quiet_NaN(); }
  return cost == Cost::cpu_time ? run.cpu_seconds : static_cast<double>(cost == Cost::memory ? run.peak_bytes : run.links);
}

// A dash where the peak is not known.
[[nodiscard]] inline std::string memory_text(const Run& run) { return run.peak_bytes > 0 ? bytes_text(run.peak_bytes) : "–"; }

[[nodiscard]] inline CostPoint point_of(const Run& run, const Reference& reference, Cost cost) {
  const KnownError error = main_error(run, reference);
  return {cost_of(run, cost), error.value, error.limited};
}

// One a run.
[[nodiscard]] inline std::vector<CostPoint> points_of(const Method& method, const Reference& reference, Cost cost) {
  std::vector<CostPoint> points;
  for (const Run& run : method.runs) { points.push_back(point_of(run, reference, cost)); }
  return points;
}

// The runs of all methods that no other run beats in error and CPU time.
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

// The cheapest run of a method whose error is at most `target`.
[[nodiscard]] inline const Run* cheapest_within(const Method& method, const Reference& reference, double target, Cost cost) {
  const Run* best = nullptr;
  for (const Run& run : method.runs) {
    const bool reached = main_error(run, reference).value <= target;  // false for NaN
    if (reached && (best == nullptr || cost_of(run, cost) < cost_of(*best, cost))) { best = &run; }
  }
  return best;
}

// The run of least error; of equal ones the cheapest.
[[nodiscard]] inline const Run* most_accurate(const Method& method, const Reference& reference) {
  const Run* best = nullptr;
  for (const Run& run : method.runs) {
    const double error = main_error(run, reference).value;
    if (!std::isfinite(error)) { continue; }
    const double least = best == nullptr ? std::numeric_limits<double>::infinity() : main_error(*best, reference).value;
    if (error < least || (error == least && run.cpu_seconds < best->cpu_seconds)) { best = &run; }
  }
  return best;
}

// The errors at which methods are compared: up to three of 10 %, 5 %, 2 %, 1 %, ..., the smallest that any run reaches.
[[nodiscard]] inline std::vector<double> targets(const SceneStudy& scene) {
  std::vector<double> reached;
  for (int decade = 0; decade >= -9; --decade) {
    for (const double k : {1.0, 0.5, 0.2}) {
      const double target = k * std::pow(10.0, decade);
      for (const Method& method : scene.methods) {
        if (cheapest_within(method, scene.reference, target, Cost::cpu_time) != nullptr) {
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
