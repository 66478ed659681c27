// SPDX-License-Identifier: MIT
#pragma once

// Sums up a run for its audit: row sums, energy, means of the input surfaces, what was left out.

#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/saving.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

// Emitted = absorbed + escaped, summed over the channels (in closed scenes nothing escapes).
void balance_energy(Audit& audit, const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity);

Audit::Range summarise_rows(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows);

// The share of the exposed area of leaves whose row sum is above this.
inline constexpr double most_row_sum = 1.1;
double overfull_share(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows);

// A square and an equilateral triangle have proportion 1 here: that of each kind is taken relative to its best.
Audit::Range summarise_proportions(const Hierarchy& hierarchy, const Patches& patches);

// A sheet of which nothing is left (a window that was cut out ends outside the wall) is no surface; one that is buried has area 0.
void summarise_surfaces(Audit& audit, const DiscreteScene& scene, const std::vector<Color>& radiosity);

// What the run left out, beyond what the plan had proven before it. `cost`: of what was not left out.
void report_left_out(Audit& audit, const DiscreteScene& scene, const RefineResult& refined, const EvaluateResult& evaluated,
                     const Options& options, const LinkCost& cost);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/summary.cpp>
#endif
