// SPDX-License-Identifier: MIT
#include <radiosity/audit/accuracy_target.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// About half of what the solver accepts (too_many_links), because a round has up to twice the links of the one before.
inline constexpr std::uint64_t link_budget = 10'000'000;

// Limit on the work of all solutions and pictures together, counted in path-tracing rays of a scene of few polygons (audit_effort.hpp),
// about a microsecond each. It depends neither on the target nor on what the audits found.
inline constexpr std::uint64_t work_budget = 40'000'000;

// Before this much work rounds without gain end nothing: the next round costs little, and it may be the first to find light that passes
// through an opening smaller than the patches before it.
inline constexpr std::uint64_t work_before_giving_up = work_budget / 2;

// Rays that the audits of all rounds together may take beyond their shares, to confirm the target (AuditGoal::reserve). They are spent
// only where refining would cost more. About ten seconds.
inline constexpr std::uint64_t reserve_of_audits = 40'000'000;

namespace detail {

// The measured error that the target refers to.
[[nodiscard]] HALFLIGHT_INLINE std::optional<ErrorEstimate> aimed_error(const Audit& audit, const Options& options, bool of_picture) {
  if (of_picture) { return audit.picture_error ? std::optional{audit.picture_error->error} : std::nullopt; }
  return options.reconstruction != Reconstruction::none ? audit.surface_error : audit.leaf_error;
}

// Bytes that the solution occupies, without its BReps, which are freed when the run ends.
HALFLIGHT_INLINE std::uint64_t bytes_of(const Solution& solution) {
  const Mesh& mesh = solution.mesh;
  return solution.hierarchy.capacity() * (sizeof(Node) + sizeof(Color) + 2 * sizeof(double)) +
         (solution.links.capacity() + solution.ray_links.capacity()) * sizeof(Link) + mesh.positions.capacity() * sizeof(glm::dvec3) +
         mesh.corners.capacity() * sizeof(MeshCorner) + mesh.faces.capacity() * sizeof(MeshFace);
}

// Chooses the thresholds of each round.
class Rounds {
 public:
  Rounds(const Options& options, bool of_picture) : round_{options}, of_picture_{of_picture} {
    round_.epsilon = 0.04;
    round_.min_area = 3.84e-3;
    round_.target = 0.16;
    round_.audit_reserve = reserve_of_audits;
  }

  [[nodiscard]] const Options& options() const { return round_; }

  // Returns the reason why no round follows this one, or an empty string. The thresholds of the next round are reduced where the error
  // is: for the light of lamps, for the rest, or for both.
  [[nodiscard]] std::string next(const Audit& audit) {
    const std::optional<ErrorEstimate>& error = !of_picture_          ? audit.steering_error
                                                : audit.picture_error ? audit.picture_error->steering
                                                                      : nothing_;
    // While noise hides the error, nothing is known about it: a finer solution may bring a larger audit, which then shows the error.
    const bool seen = error && error->low > 0.0;
    const bool gained = seen && (!least_ || error->relative_l2 < 0.95 * *least_);
    if (gained) { least_ = error->relative_l2; }
    if (seen) { without_gain_ = gained ? 0 : without_gain_ + 1; }
    const double direct = of_picture_ || !gained ? 0.5 : audit.direct_share.value_or(0.5);
    constexpr double step = 0.55;
    round_.light_epsilon = (direct > 0.35 ? step : 1.0) * audit.light_epsilon;
    if (direct < 0.65) {
      round_.epsilon *= step;
      round_.min_area *= step * step;  // scales with the area that shadow ends and contacts leave unresolved
    }
    round_.target *= 0.5;
    const std::uint64_t used = audit.reserve_used + (audit.picture_error ? audit.picture_error->reserve_used : 0);
    round_.audit_reserve -= std::min(round_.audit_reserve, used);
    const bool floor =
        round_.refinement == Refinement::a_priori ? round_.epsilon < 1e-5 || *round_.light_epsilon < 1e-6 : round_.target < 1e-4;
    // A round mostly takes about twice the work of the one before it.
    const std::uint64_t work = rays_worth(audit) + (audit.picture_error ? audit.picture_error->picture_work : 0);
    work_ += work;
    if (audit.links > link_budget) { return "its limit of " + std::to_string(link_budget / 1'000'000) + " million links"; }
    if (work_ + 2 * work > work_budget) {
      return "its limit of work, as much as " + std::to_string(work_budget / 1'000'000) + " million rays";
    }
    const bool in_vain = without_gain_ >= 3 && work_ >= work_before_giving_up;
    return floor ? "the finest thresholds" : in_vain ? "three rounds without gain" : "";
  }

 private:
  Options round_;
  bool of_picture_;
  std::optional<double> least_;  // smallest error seen so far, above the noise
  int without_gain_ = 0;         // rounds
  std::uint64_t work_ = 0;       // of all rounds so far, in rays
  const std::optional<ErrorEstimate> nothing_{};
};

HALFLIGHT_INLINE Failure not_measurable(bool of_picture) {
  return {Failure::Kind::invalid_options,
          {of_picture ? "no pixel of the picture shows reflected light whose paths end, so its error cannot be measured; aim at "
                        "the error over all surfaces, or give an epsilon instead of an error"
                      : "the error of this scene cannot be measured, for its paths do not end or meet no light; give an "
                        "epsilon instead of an error"}};
}

// What was short, of a failure for lack of memory.
HALFLIGHT_INLINE std::string sentence_of(const Failure& shortage) {
  return shortage.sentences.empty() ? "no more memory" : shortage.sentences.front();
}

// Measures the picture of the solution, and returns its error, if that is possible.
HALFLIGHT_INLINE std::optional<ErrorEstimate> measured_again(
    Solution& solution, const std::function<std::optional<PictureError>(const Solution&)>& measure_picture,
    std::vector<StageTime>& stages) {
  std::vector<StageTime> times;
  Stopwatch watch{times};
  const std::optional<PictureError> again = measure_picture(solution);
  watch.lap("audit");
  add_times(stages, times);
  if (!again) { return std::nullopt; }
  solution.audit.picture_error = again;
  return again->error;
}

HALFLIGHT_INLINE Outcome solve_to_error(const Options& options,
                                        const std::function<Outcome(const Options&, std::uint64_t held)>& solve_round,
                                        const std::function<std::optional<PictureError>(const Solution&)>& measure_picture) {
  const double wanted = *options.error;
  const bool of_picture = static_cast<bool>(measure_picture);
  Rounds rounds{options, of_picture};
  std::vector<StageTime> stages;
  Outcome best;
  std::optional<ErrorEstimate> best_error;
  std::string ended_by, later_shortage;  // later_shortage: of a round after the best one; it matters only if the target is missed
  for (bool over = false; !over;) {
    Outcome outcome = solve_round(rounds.options(), best.solution ? bytes_of(*best.solution) : 0);
    if (!outcome.solution) {
      if (!best.solution) { return outcome; }
      best.solution->audit.interrupted = outcome.failure.kind == Failure::Kind::cancelled;
      if (outcome.failure.kind == Failure::Kind::out_of_memory) { later_shortage = sentence_of(outcome.failure); }
      break;
    }
    const Audit& audit = outcome.solution->audit;
    add_times(stages, audit.stages);
    const std::optional<ErrorEstimate> error = aimed_error(audit, options, of_picture);
    if (!error && !audit.interrupted) { return {std::nullopt, not_measurable(of_picture)}; }
    ended_by = rounds.next(audit);
    over = (error && error->within(wanted)) || audit.interrupted || !audit.shortage.empty() || !ended_by.empty();
    const bool interrupted = audit.interrupted;
    if (!best.solution || !best_error || (error && !(best_error->high < error->low))) {
      best = std::move(outcome);
      best_error = error;
    } else {
      later_shortage = std::move(outcome.solution->audit.shortage);
    }
    best.solution->audit.interrupted = best.solution->audit.interrupted || interrupted;
  }
  Audit& audit = best.solution->audit;
  if (of_picture && !audit.interrupted && !(best_error && best_error->within(wanted))) {
    const std::optional<ErrorEstimate> again = measured_again(*best.solution, measure_picture, stages);
    if (again) { best_error = again; }
  }
  audit.target_missed = !(best_error && best_error->within(wanted));
  if (audit.target_missed) {
    if (audit.shortage.empty()) { audit.shortage = std::move(later_shortage); }
    audit.rounds_ended_by = audit.interrupted ? "an interruption" : !audit.shortage.empty() ? "want of memory" : ended_by;
  }
  audit.converged = audit.converged && !audit.interrupted && audit.shortage.empty() && !audit.target_missed;
  audit.stages = std::move(stages);
  sum_times(audit);
  return best;
}

}  // namespace detail

}  // namespace radiosity
