// SPDX-License-Identifier: MIT
#pragma once

// A study with made-up figures: error = factor * time^exponent for every method, exactly, so that slopes, fronts and places in a plot are
// known.

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "apps/study/results.hpp"

namespace made_up {

struct Law {
  const char* name;
  double factor;    // the error at 1 s
  double exponent;  // of time
  double start;     // seconds of the cheapest setting
};

inline constexpr Law laws[] = {{"hierarchical F", 0.010, -0.5, 0.02},     {"hierarchical F, clusters", 0.012, -0.5, 0.03},
                               {"hierarchical BF", 0.008, -0.6, 0.05},    {"hierarchical BF, clusters", 0.01, -0.6, 0.06},
                               {"BF to a target", 0.009, -0.55, 0.08},    {"BF to a target, clusters", 0.011, -0.55, 0.1},
                               {"classical quad-tree", 0.02, -0.4, 0.04}, {"uniform, dense matrix", 0.03, -0.3, 0.01},
                               {"progressive", 0.025, -0.33, 0.005}};

inline constexpr double noise = 0.004;

inline study::Errors errors(double l2) { return {{0.7 * l2, l2, 4.0 * l2}, {0.8 * l2, 1.2 * l2, 6.0 * l2}}; }

// Settings 4 times as dear as the one before.
inline study::Method method(const Law& law) {
  study::Method result{law.name, std::string("made up: falls as the power ") + std::to_string(law.exponent), {}};
  double seconds = law.start;
  for (int i = 0; i < 6; ++i, seconds *= 4.0) {
    study::Run run;
    run.setting = "epsilon " + std::to_string(0.1 / (1 << (2 * i))).substr(1, 6);
    run.cpu_seconds = seconds;
    run.seconds_saved = 0.3 * seconds;
    run.bytes = static_cast<std::uint64_t>(1e6 * seconds);
    run.peak_bytes = 2 * run.bytes;
    run.links = static_cast<std::uint64_t>(4e5 * seconds);
    run.leaves = static_cast<std::uint64_t>(1e4 * std::sqrt(seconds));
    run.rays = 10 * run.links;
    const double error = law.factor * std::pow(seconds, law.exponent);
    run.leaves_error = errors(error);
    run.simple_error = errors(0.8 * error);
    run.weighted_error = errors(0.7 * error);
    if (i % 2 == 0) { run.parts = study::ErrorParts{0.8 * error, 0.3 * error, 1e-7, 0.2 * error}; }
    result.runs.push_back(run);
  }
  return result;
}

// The unit cube seen from inside, 12 x 12 cells a wall; the error is a wave of this height.
inline study::ErrorPicture picture(const std::string& name, double height) {
  study::ErrorPicture result{name, "epsilon .00625", {}};
  constexpr int n = 12;
  for (int wall = 0; wall < 6; ++wall) {
    for (int i = 0; i < n * n; ++i) {
      const auto corner = [&](int k, int l) {
        const double u = (i % n + k) / static_cast<double>(n);
        const double v = static_cast<double>(i / n + l) / n;
        const double w = wall % 2 == 0 ? 0.0 : 1.0;
        return wall / 2 == 0 ? glm::dvec3(w, u, v) : wall / 2 == 1 ? glm::dvec3(v, w, u) : glm::dvec3(u, v, w);
      };
      study::ErrorCell cell{{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
                            height * std::sin(0.5 * (i % n)) * std::cos(0.4 * (i / n))};
      if (wall % 2 == 1) { std::swap(cell.corners[1], cell.corners[3]); }
      result.cells.push_back(std::move(cell));
    }
  }
  return result;
}

inline study::SceneStudy scene(const std::string& name, double reference_noise) {
  study::SceneStudy result;
  result.scene = name;
  result.title = "a closed room & a <lamp>: \"made up\"";
  result.camera.eye = {0.5, -1.4, 0.5};
  result.camera.field_of_view = 42.0;
  result.camera.size = radiosity::PictureSize{600, 600};
  result.reference = {
      reference_noise > 0.0 ? "path traced" : "analytic", reference_noise, 1.2 * reference_noise, 864, 2000, 4000000, false};
  for (const Law& law : laws) {
    result.methods.push_back(method(law));
    result.pictures.push_back(picture(law.name, 2.0 * law.factor));
  }
  result.methods[7].runs[5] = study::Run{};
  result.methods[7].runs[5].setting = "8192 cells, \"dense\"";
  result.methods[7].runs[5].refused = "the matrix needs 4 GB, and 2 GB are allowed";
  for (study::Run& run : result.methods[8].runs) {
    run.simple_error.points.l2 = std::numeric_limits<double>::quiet_NaN();
    run.weighted_error.points.l2 = std::numeric_limits<double>::quiet_NaN();
  }
  result.left_out = {{"two colour channels", "every material is grey", "two thirds of the solver's arithmetic"}};
  return result;
}

inline study::Study study_of_one() {
  study::Study result;
  result.scenes = {scene("made up", noise)};
  result.machine = "a machine, 2 cores";
  result.compiler = "a compiler 12";
  result.version = "1.0";
  result.seed = 7;
  return result;
}

}  // namespace made_up
