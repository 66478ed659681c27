// SPDX-License-Identifier: MIT
#pragma once

// The rounds that meet an error target: ever finer solutions, until the audit confirms that one is fine enough.
//
// The target does not change the rounds; it only decides after which of them the run ends. A tighter target therefore ends at the same
// solution as a looser one or at a finer one (or earlier, if its larger audit already shows that the target is met). An audit that leaves
// the target open is enlarged before the solution is refined, if that is likely to show that the target is met for less than refining costs
// (AuditGoal::reserve), because refining does not reduce the noise of the paths. A run gives up when a round needed more than link_budget
// links, when the next round would bring the total work above work_budget, when the thresholds have reached their lower limit, or when
// three rounds in a row did not improve on the best one and half of work_budget is done; Audit::rounds_ended_by says which. It also ends
// when a round would need more memory than Options::memory (or its default); see Audit::shortage. All of this is counted, not timed, and
// does not depend on the target. The run then returns its last solution, unless an earlier one is better by more than the uncertainty of
// both audits. The size of an audit depends on the target. So that the rounds do not, they are planned and compared by a separate set of
// points (Audit::steering_error, PictureError::steering).
//
// The audits of the rounds use just enough pixels to decide that the error of a picture is too large. Knowing how large it is takes more,
// so the picture that misses its target is measured again at the end; if that shows that it meets the target after all, it does.

#include <cstdint>
#include <functional>
#include <optional>

#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

namespace detail {

// `solve_round` solves at the fineness of the given options and measures the errors; `held`: bytes that an earlier solution
// occupies meanwhile. `measure_picture`: if the target is that of a picture, measures its error with the effort of a run without target.
[[nodiscard]] Outcome solve_to_error(const Options& options, const std::function<Outcome(const Options&, std::uint64_t held)>& solve_round,
                                     const std::function<std::optional<PictureError>(const Solution&)>& measure_picture = {});

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/accuracy_target.cpp>
#endif
