// SPDX-License-Identifier: MIT
#pragma once

// A stiff or extreme case: scenes that are solved, and measured figures, each with its bound. What happened (solved, warned, refused) is
// recorded; why it is correct is stated by the case. All figures depend on the scenes only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/stress/scenes.hpp"

namespace apps::stress {

// A measured number and its bound. NaN satisfies no bound.
struct Figure {
  enum class Bound { at_most, at_least, exactly };
  std::string what;
  double measured = 0.0;
  Bound kind = Bound::at_most;
  double bound = 0.0;

  [[nodiscard]] bool holds() const {
    return kind == Bound::at_most ? measured <= bound : kind == Bound::at_least ? measured >= bound : measured == bound;
  }
};

// The results of running a case.
class Findings {
 public:
  void at_most(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::at_most, bound});
  }
  void at_least(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::at_least, bound});
  }
  void exactly(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::exactly, bound});
  }

  // Solves a scene that must have a solution. If there is none, or a radiosity is not finite, the case fails, and the result is empty.
  radiosity::Solution solve(const radiosity::Scene& scene, const radiosity::Options& options, const radiosity::Control& control = {});
  // Expects that a scene or an object is refused with a sentence that contains `word`.
  void refuse(const std::string& what, const radiosity::Scene& scene, const radiosity::Options& options, std::string_view word);
  void refuse(const std::string& what, const std::string& sentence, std::string_view word);
  // Expects that the solution has a warning that contains `word`.
  void warned(const std::string& what, const radiosity::Solution& solution, std::string_view word);

  [[nodiscard]] const std::vector<Figure>& figures() const { return figures_; }
  [[nodiscard]] const std::vector<std::string>& refusals() const { return refusals_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  [[nodiscard]] std::uint32_t solved() const { return solved_; }
  [[nodiscard]] bool hold() const;

 private:
  std::vector<Figure> figures_;
  std::vector<std::string> refusals_, warnings_;  // the expected sentences
  std::uint32_t solved_ = 0;
};

// A row: what is stressed, why the program's behaviour is correct, and the function that runs the scenes and records the figures.
struct Case {
  std::string_view name;
  std::string_view what;
  std::string_view why;
  void (*run)(Findings&);
};

[[nodiscard]] std::span<const Case> light_cases();     // reflectance, emission, the linear system
[[nodiscard]] std::span<const Case> contact_cases();   // touching, coincident and overlapping objects
[[nodiscard]] std::span<const Case> boundary_cases();  // shells, normals, occlusion
[[nodiscard]] std::span<const Case> size_cases();      // scale, position, thinness, number and depth

// All cases, in the order in which they are run.
[[nodiscard]] const std::vector<Case>& cases();

// --- used by all cases: settings, and measures of a solution

using radiosity::Color;
using radiosity::Options;
using radiosity::Scene;
using radiosity::Solution;

// Coarse and fast, for figures that do not depend on the mesh, or only within the bound of their case.
inline Options coarse() { return {.epsilon = 0.1, .min_area = 1e-3, .audit_points = 0}; }

// For figures that do depend on it.
inline Options finer() {
  Options options = coarse();
  options.epsilon = 0.02;
  options.min_area = 1e-4;
  return options;
}

// Mean radiosity of a named surface; if there is none, NaN, which satisfies no bound.
inline Color mean_color(const Solution& solution, std::string_view surface) {
  for (const radiosity::SurfaceMean& s : solution.audit.surfaces) {
    if (s.name == surface) { return s.radiosity; }
  }
  return Color{std::numeric_limits<double>::quiet_NaN()};
}
inline double mean(const Solution& solution, std::string_view surface) { return mean_color(solution, surface).x; }

// The exposed area of a named surface; 0 if there is none.
inline double area(const Solution& solution, std::string_view surface) {
  const auto& all = solution.audit.surfaces;
  const auto found = std::find_if(all.begin(), all.end(), [&](const radiosity::SurfaceMean& s) { return s.name == surface; });
  return found == all.end() ? 0.0 : found->area;
}

inline double relative(double value, double reference) { return std::abs(value / reference - 1.0); }

// The largest deviation, in any channel, of an exposed leaf from the value that all should have.
inline double worst(const Solution& solution, double value) {
  double difference = solution.mesh.faces.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (!(solution.area[face.node] > 0.0)) { continue; }
    for (int c = 0; c < 3; ++c) { difference = std::max(difference, std::abs(face.radiosity[c] - value)); }
  }
  return difference;
}

// The largest relative difference of the means of two solutions of the same surfaces, over surfaces that are lit in the second.
inline double largest_relative_difference(const Solution& a, const Solution& b) {
  double difference = a.audit.surfaces.size() == b.audit.surfaces.size() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < a.audit.surfaces.size() && i < b.audit.surfaces.size(); ++i) {
    const double reference = b.audit.surfaces[i].radiosity.x;
    if (reference > 0.0) { difference = std::max(difference, relative(a.audit.surfaces[i].radiosity.x, reference)); }
  }
  return difference;
}

// Number of nodes whose radiosity is not bit-identical to that of the other solution times `factor`; all if the meshes differ.
inline double other_bits(const Solution& a, const Solution& b, double factor = 1.0) {
  if (a.radiosity.size() != b.radiosity.size()) { return static_cast<double>(std::max(a.radiosity.size(), b.radiosity.size())); }
  double count = 0.0;
  for (std::size_t i = 0; i < a.radiosity.size(); ++i) { count += a.radiosity[i] == factor * b.radiosity[i] ? 0.0 : 1.0; }
  return count;
}

}  // namespace apps::stress
