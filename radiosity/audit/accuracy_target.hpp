// SPDX-License-Identifier: MIT
#pragma once

// The rounds that meet an error target: ever finer solutions, until the audit confirms that one is fine enough.
//
// The target does not change the rounds; it only decides after which of them the run ends. So a tighter target ends at the same solution as
// a looser one, or at a finer one; or sooner, where its larger audit shows that it is met. A run gives up when a round needed
// more than link_budget links, when the next one would bring the work of all above work_budget, when the thresholds have reached their
// floor, or when three rounds running were no better than the best before them; Audit::rounds_ended_by says which. It ends, too, when a
// round would take more memory than Options::memory allows, or memory_of_rounds where that says nothing (Audit::shortage). All that is
// counted, not timed, and does not depend on the target. It then returns the last one, unless an earlier one is better beyond the doubt of
// both audits. The size of an audit depends on the target; so that the rounds do not, they are planned and compared by points of their own
// (Audit::steering_error, PictureError::steering).

#include <cstdint>
#include <functional>

#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

namespace detail {

// `solve_round` solves at a given fineness, while so many bytes are held by an earlier solution, and measures the errors.
[[nodiscard]] Outcome solve_to_error(const Options& options, bool of_picture,
                                     const std::function<Outcome(const Options&, std::uint64_t held)>& solve_round);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/accuracy_target.cpp>
#endif
