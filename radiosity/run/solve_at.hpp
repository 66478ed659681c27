// SPDX-License-Identifier: MIT
#pragma once

// One run at a given fineness.

#include <cstdint>

#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

namespace detail {

// One run within the memory that there is. When BF-refinement has run out of memory, its state is lost: the run is made again, in the
// memory that is free then, up to the last generation that had a solution, or to one before it. Generations grow, so that takes no longer
// than the run that was lost.
[[nodiscard]] Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held = 0);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/solve_at.cpp>
#endif
