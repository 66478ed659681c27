// SPDX-License-Identifier: MIT
#pragma once

// One run at a given fineness.

#include <cstdint>

#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

namespace detail {

// One run within the memory that there is. When that has run out, the run is made again, in the memory that is free then: of
// BF-refinement up to the last generation that had a solution, or to one before it, of F-refinement with larger thresholds, until it fits.
// Generations grow, and F-refinement tells early what it will need, so what is lost takes about as long as the run that fits. The
// times of the runs that were lost are told. `held`: by the solution of an earlier round, if there is one; a coarser one is of no use then.
[[nodiscard]] Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held = 0);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/solve_at.cpp>
#endif
