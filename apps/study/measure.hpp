// SPDX-License-Identifier: MIT
#pragma once

// Runs every method at every setting on one scene and measures each result against the same reference, by the same clock: CPU
// seconds of all threads, without audits (unless the method needs them) and without what only the study wants to know.

#include <functional>
#include <vector>

#include "apps/study/methods.hpp"
#include "apps/study/reference.hpp"
#include "apps/study/results.hpp"

namespace study {

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
