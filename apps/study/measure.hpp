// SPDX-License-Identifier: MIT
#pragma once

// The methods that a study compares, each with settings from coarse to fine. Every method is run with every setting on one scene, and
// each result is compared with the same reference and timed by the same clock: CPU seconds of all threads, without audits (unless the
// method needs them) and without the extra measurements for the study.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/radiosity.hpp>

#include "apps/study/reference.hpp"
#include "apps/study/results.hpp"

namespace study {

struct Setting {
  std::string text;  // "epsilon 0.01"
  // The timed run; its solution contains a comparison, usually without a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> run;
  // A solution on the same leaves as `found`, a result of this setting, with a comparison that contains a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Solution& found, const radiosity::Control&)> dense;
  // The same run without shortcuts; empty if the method has none.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> without_shortcuts;
};

struct MethodPlan {
  std::string name;
  std::string summary;
  std::vector<Setting> settings;  // by increasing cost
};

struct MethodOptions {
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> memory;  // bytes that a run may use
};

// (methods.cpp) A new method is one more entry there.
[[nodiscard]] std::vector<MethodPlan> methods(const MethodOptions& options);

struct MeasureOptions {
  double cpu_seconds_per_run = 12.0;  // a run that takes longer is stopped, and finer settings of its method are skipped
  std::uint32_t dense_leaves = 3000;  // the parts of an error are computed for at most this number of leaves
  // Called at the end of a run.
  std::function<void(const Method&, const Run&)> finished;
};

// The values of a mesh at the points of a reference. `leaf_values`: one colour per node, used instead of the colours of the mesh,
// constant on each leaf that is not buried.
[[nodiscard]] std::vector<radiosity::Color> values_at(const radiosity::Scene& scene, const radiosity::Solution& solution,
                                                      const radiosity::Mesh& mesh, const TrueRadiosity& truth,
                                                      const std::vector<radiosity::Color>* leaf_values = nullptr);

// Fills in methods, pictures, reference and what was left out of the scene. If cancelled, finished results are kept.
void measure(const radiosity::Scene& scene, const TrueRadiosity& truth, const std::vector<MethodPlan>& methods,
             const MeasureOptions& options, const radiosity::Control& control, SceneStudy& study);

}  // namespace study
