// SPDX-License-Identifier: MIT
#pragma once

// The methods that a study compares, each with its settings from coarse to fine. Every method is run at every setting on one scene, and
// each result is measured against the same reference, by the same clock: CPU seconds of all threads, without audits (unless the method
// needs them) and without what only the study wants to know.

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
  // Timed; the solution brings a comparison, as a rule without a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> run;
  // A solution with the same leaves as `found`, which this setting has given, whose comparison has a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Solution& found, const radiosity::Control&)> dense;
  // The same run with nothing left out; empty where the method leaves nothing out.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> without_shortcuts;
};

struct MethodPlan {
  std::string name;
  std::string summary;
  std::vector<Setting> settings;  // each costs more than the one before
};

struct MethodOptions {
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> memory;  // bytes that a run may take
};

// (methods.cpp) A new method is one more entry there.
[[nodiscard]] std::vector<MethodPlan> methods(const MethodOptions& options);

struct MeasureOptions {
  double cpu_seconds_per_run = 12.0;  // a run that takes longer is stopped, and finer settings of its method are not tried
  std::uint32_t dense_leaves = 3000;  // the parts of an error are told apart on at most so many leaves
  // Called when a run ends: method, run.
  std::function<void(const Method&, const Run&)> finished;
};

// The values of a mesh at the points of a reference. `leaf_values`: one colour a node, to be shown instead of the mesh's own colours,
// constant on each leaf that is not buried.
[[nodiscard]] std::vector<radiosity::Color> values_at(const radiosity::Scene& scene, const radiosity::Solution& solution,
                                                      const radiosity::Mesh& mesh, const TrueRadiosity& truth,
                                                      const std::vector<radiosity::Color>* leaf_values = nullptr);

// Fills in methods, pictures, reference and what was left out. When cancelled, what is finished stays.
void measure(const radiosity::Scene& scene, const TrueRadiosity& truth, const std::vector<MethodPlan>& methods,
             const MeasureOptions& options, const radiosity::Control& control, SceneStudy& study);

}  // namespace study
