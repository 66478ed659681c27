// SPDX-License-Identifier: MIT
#pragma once

// What all cases need: names, scenes, and what is measured of a solution.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/stress/case.hpp"
#include "apps/stress/scenes.hpp"

namespace apps::stress {

using radiosity::Color;
using radiosity::Options;
using radiosity::Scene;
using radiosity::Solution;

// Coarse and fast: what is measured does not depend on the mesh, or only within the bound of its case.
inline Options coarse() {
  Options options;
  options.epsilon = 0.1;
  options.min_area = 1e-3;
  options.audit_points = 0;
  return options;
}

// For what does depend on it.
inline Options finer() {
  Options options = coarse();
  options.epsilon = 0.02;
  options.min_area = 1e-4;
  return options;
}

// Mean radiosity of a named surface; NaN, which keeps no bound, when there is none.
inline Color mean_color(const Solution& solution, std::string_view surface) {
  for (const radiosity::SurfaceMean& s : solution.audit.surfaces) {
    if (s.name == surface) { return s.radiosity; }
  }
  return Color{std::numeric_limits<double>::quiet_NaN()};
}
inline double mean(const Solution& solution, std::string_view surface) { return mean_color(solution, surface).x; }

// The exposed area of a named surface; 0 when there is none.
inline double area(const Solution& solution, std::string_view surface) {
  const auto& all = solution.audit.surfaces;
  const auto found = std::find_if(all.begin(), all.end(), [&](const radiosity::SurfaceMean& s) { return s.name == surface; });
  return found == all.end() ? 0.0 : found->area;
}

inline double relative(double value, double reference) { return std::abs(value / reference - 1.0); }

// The largest difference of any exposed leaf from the value that all should have, in any channel.
inline double worst(const Solution& solution, double value) {
  double difference = solution.mesh.faces.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (!(solution.area[face.node] > 0.0)) { continue; }
    for (int c = 0; c < 3; ++c) { difference = std::max(difference, std::abs(face.radiosity[c] - value)); }
  }
  return difference;
}

// The largest relative difference of the means of two solutions of the same surfaces, where the second has light.
inline double apart(const Solution& a, const Solution& b, double factor = 1.0) {
  double difference = a.audit.surfaces.size() == b.audit.surfaces.size() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < a.audit.surfaces.size() && i < b.audit.surfaces.size(); ++i) {
    const double reference = factor * b.audit.surfaces[i].radiosity.x;
    if (reference > 0.0) { difference = std::max(difference, relative(a.audit.surfaces[i].radiosity.x, reference)); }
  }
  return difference;
}

// Leaves whose radiosity is not bit by bit that of the other solution times `factor`; all when the meshes differ.
inline double other_bits(const Solution& a, const Solution& b, double factor = 1.0) {
  if (a.radiosity.size() != b.radiosity.size()) { return static_cast<double>(std::max(a.radiosity.size(), b.radiosity.size())); }
  double count = 0.0;
  for (std::size_t i = 0; i < a.radiosity.size(); ++i) { count += a.radiosity[i] == factor * b.radiosity[i] ? 0.0 : 1.0; }
  return count;
}

}  // namespace apps::stress
