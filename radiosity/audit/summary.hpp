// SPDX-License-Identifier: MIT
#pragma once

// Summarises a run for its audit: row sums, energy balance, means of the input surfaces, shortcuts taken.

#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/saving.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/refine_result.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

// Emitted = absorbed + escaped, summed over the channels (in closed scenes nothing escapes).
void balance_energy(Audit& audit, const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity);

// Range and area-weighted mean of the row sums of the leaves.
Audit::Range summarise_rows(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows);

// Share of the exposed area whose leaves have row sums above most_row_sum.
inline constexpr double most_row_sum = 1.1;
double overfull_share(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows);

// Range of the proportions of the leaves, each relative to the regular polygon with as many corners, so that squares and
// equilateral triangles have 1.
Audit::Range summarise_proportions(const Hierarchy& hierarchy, const Patches& patches);

// A sheet without faces (a cut-out window that ends outside the wall) is left out; a buried sheet is listed with area 0.
void summarise_surfaces(Audit& audit, const DiscreteScene& scene, const std::vector<Color>& radiosity);

// Reports the shortcuts that the run took, beyond those that plan.hpp had proven before it. `cost`: measured cost of the links
// that were evaluated.
void report_left_out(Audit& audit, const DiscreteScene& scene, const RefineResult& refined, const EvaluateResult& evaluated,
                     const Options& options, const LinkCost& cost);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/summary.cpp>
#endif
