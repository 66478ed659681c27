// SPDX-License-Identifier: MIT
#pragma once

// The results of a work-precision study, as data: for every scene a reference and, for every method, one run per setting. measure.hpp
// fills them in; tables, plots and pages read them; these two sides are independent. After Willmott and Heckbert 1997: the same scene,
// reference and clock, and several settings for every method.

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

// Errors of the radiosity on the surfaces that do not emit (if all do, on all), weighted by area: L1 and L2 relative to the same norm of
// the reference, the worst relative to the reference's largest value. They include the reference's noise.
struct Norms {
  double l1 = 0.0;
  double l2 = 0.0;
  double worst = 0.0;
};

struct Errors {
  Norms cells;   // of the means over the reference's cells
  Norms points;  // at the reference's points
};

// The sources of the error, each as a relative L2 error at the reference's points. By the triangle inequality, the error of the leaves is
// at most the sum of the first two.
struct ErrorParts {
  double discretisation = 0.0;  // a dense solution on the run's leaves, compared with the reference
  double links = 0.0;           // the run's solution compared with that dense solution: error of links and visibility
  double solver = 0.0;          // the relative residual
  double reconstruction = 0.0;  // effect of interpolation: reconstruction compared with leaves
};

struct Run {
  std::string setting;  // as on the command line: "epsilon .01"
  double cpu_seconds = 0.0;
  // CPU time of the same run without shortcuts minus that of this run; NaN if the method has none or that run takes too long.
  double seconds_saved = std::numeric_limits<double>::quiet_NaN();
  // Peak memory of the run minus what the process held at its beginning; 0 if the system does not tell.
  std::uint64_t peak_bytes = 0;
  std::uint64_t bytes = 0;  // held by the result
  std::uint64_t links = 0;  // or matrix entries, for dense matrices
  std::uint64_t leaves = 0;
  std::uint64_t rays = 0;
  Errors leaves_error;                                    // constant per leaf, before reconstruction
  Errors simple_error;                                    // simple reconstruction (paper figs. 6-8)
  Errors weighted_error;                                  // weighted reconstruction (paper fig. 5)
  std::optional<radiosity::ErrorEstimate> picture_error;  // of the picture that the scene's camera sees (radiosity/audit/picture_error.hpp)
  std::optional<ErrorParts> parts;
  std::string refused;  // why there is no result; else empty
  std::string cut_off;  // why the run was stopped early: its result is the best until then and not counted for any cost
};

struct Method {
  std::string name;     // "hierarchical F"
  std::string summary;  // one line for the page
  std::vector<Run> runs;
};

// A cell of the reference in the error picture: corners in the scene's coordinates, error relative to the largest reference value.
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
  double point_noise = 0.0;  // the same for the points
  std::uint64_t cells = 0;
  std::uint64_t points = 0;
  std::uint64_t paths = 0;
  bool cached = false;  // was it read from a file?
};

struct SceneStudy {
  std::string scene;         // name of its file, without folder and extension
  std::string title;         // the difficulty that it isolates: first comment line of its file
  radiosity::Camera camera;  // for the error pictures: the first one of the file, or the automatic one
  Reference reference;
  std::vector<Method> methods;
  std::vector<ErrorPicture> pictures;  // one per method, at the setting with an error nearest to 1 %
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
