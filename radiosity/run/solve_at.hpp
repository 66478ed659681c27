// SPDX-License-Identifier: MIT
#pragma once

// One run at a given fineness.

#include <cstdint>

#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

namespace detail {

// One run within the available memory. If memory runs out, the run is repeated in the memory that is then free: BF-refinement up to the
// last generation with a solution, or to an earlier one; F-refinement with larger thresholds, until it fits. Generations grow in size and
// F-refinement predicts its needs early, so the lost work takes about as long as the run that fits. The times of lost runs are reported.
// `held`: bytes held by the solution of an earlier round, or 0; with an earlier solution, a coarser one is useless.
[[nodiscard]] Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held = 0);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/solve_at.cpp>
#endif
