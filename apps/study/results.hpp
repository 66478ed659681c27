// SPDX-License-Identifier: MIT
#pragma once

// What a work-precision study finds out, as data: for every scene one reference and, for every method, one run a setting. The
// measuring fills it (measure.hpp), the tables, plots and pages read it; neither knows the other. After Willmott and Heckbert
// 1997: the same scene, the same reference, the same clock, and several settings for every method.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/result/error_estimate.hpp>
#include <radiosity/support/left_out.hpp>

#include "apps/scene_file.hpp"

namespace study {

// Errors of radiosity over the surfaces that do not emit (in a scene where all do, over all), weighted by area: L1 and L2 relative to
// the same norm of the reference, the worst relative to the reference's greatest value. The reference's noise is in them.
struct Norms {
  double l1 = 0.0;
  double l2 = 0.0;
  double worst = 0.0;
};

struct Errors {
  Norms cells;   // of the means over the reference's cells
  Norms points;  // at the reference's points
};

// Where the error comes from, each a relative L2 error of its own at the reference's points. By the triangle inequality the error of
// the leaves is at most the sum of the first two.
struct ErrorParts {
  double discretisation = 0.0;  // a dense solution on the run's leaves against the reference
  double links = 0.0;           // the run's links and visibility against that dense solution
  double solver = 0.0;          // the relative residual
  double reconstruction = 0.0;  // what interpolation changes: picture against leaves
};

struct Run {
  std::string setting;  // as on the command line: "epsilon .01"
  double cpu_seconds = 0.0;
  // CPU time of the same run with nothing left out, less its own; NaN where the method has no shortcuts or that run takes too long.
  double seconds_saved = std::numeric_limits<double>::quiet_NaN();
  // Peak memory of the run above what the process held when it began; 0 where the system does not tell.
  std::uint64_t peak_bytes = 0;
  std::uint64_t bytes = 0;  // held by the result
  std::uint64_t links = 0;  // or matrix entries, for a dense matrix
  std::uint64_t leaves = 0;
  std::uint64_t rays = 0;
  Errors leaves_error;                                    // constant leaves, before reconstruction
  Errors simple_error;                                    // simple reconstruction (paper figs. 6-8)
  Errors weighted_error;                                  // weighted reconstruction (paper fig. 5)
  std::optional<radiosity::ErrorEstimate> picture_error;  // of what the scene's camera sees of it (radiosity/audit/picture_error.hpp)
  std::optional<ErrorParts> parts;
  std::string refused;  // why there is no result; empty when there is one
  std::string cut_off;  // what stopped the run before it was done: its result is the best until then, and no cost is credited with it
};

struct Method {
  std::string name;     // "hierarchical F"
  std::string summary;  // one line for the page
  std::vector<Run> runs;
};

// A cell of the reference, for the false-colour error picture: corners in the scene, error relative to the greatest reference value.
struct ErrorCell {
  std::vector<glm::dvec3> corners;
  double error = 0.0;  // signed: positive is too bright
};

struct ErrorPicture {
  std::string method;
  std::string setting;
  std::vector<ErrorCell> cells;
};

struct Reference {
  std::string kind;          // "analytic" or "path traced"
  double noise = 0.0;        // relative L2 of the cell means' standard errors; 0 when analytic
  double point_noise = 0.0;  // and of the points'
  std::uint64_t cells = 0;
  std::uint64_t points = 0;
  std::uint64_t paths = 0;
  bool cached = false;  // read from beside the scene
};

struct SceneStudy {
  std::string scene;         // its file's name without folder and ending
  std::string title;         // the difficulty that it isolates: the scene file's first comment line
  radiosity::Camera camera;  // for the error pictures: the file's first, or the automatic one
  Reference reference;
  std::vector<Method> methods;
  std::vector<ErrorPicture> pictures;  // one a method, at the setting nearest to 1 % in time or error
  std::vector<radiosity::LeftOut> left_out;
};

struct Study {
  std::vector<SceneStudy> scenes;
  std::string machine;  // processor and cores
  std::string compiler;
  std::string version;
  std::uint64_t seed = 1;
};

}  // namespace study
