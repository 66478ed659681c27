// SPDX-License-Identifier: MIT
#include <radiosity/audit/accuracy_target.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/inline.hpp>

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

namespace detail {

// The error at which a target aims.
[[nodiscard]] HALFLIGHT_INLINE std::optional<ErrorEstimate> aimed_error(const Audit& audit, const Options& options, bool of_picture) {
  if (of_picture) { return audit.picture_error ? std::optional{audit.picture_error->error} : std::nullopt; }
  return options.reconstruction != Reconstruction::none ? audit.surface_error : audit.leaf_error;
}

// What the solution holds, but for its BReps, which end with the run.
HALFLIGHT_INLINE std::uint64_t bytes_of(const Solution& solution) {
  const Mesh& mesh = solution.mesh;
  return solution.hierarchy.capacity() * (sizeof(Node) + sizeof(Color) + 2 * sizeof(double)) +
         (solution.links.capacity() + solution.ray_links.capacity()) * sizeof(Link) + mesh.positions.capacity() * sizeof(glm::dvec3) +
         mesh.corners.capacity() * sizeof(MeshCorner) + mesh.faces.capacity() * sizeof(MeshFace);
}

HALFLIGHT_INLINE Outcome solve_to_error(const Options& options, bool of_picture,
                                        const std::function<Outcome(const Options&, std::uint64_t held)>& solve_round) {
  const double wanted = *options.error;
  Options round = options;
  round.epsilon = 0.04;
  round.min_area = 3.84e-3;
  round.target = 0.16;
  std::vector<StageTime> stages;
  Outcome best;
  std::optional<ErrorEstimate> best_error;
  int without_gain = 0;
  for (;;) {
    Outcome outcome = solve_round(round, best.solution ? bytes_of(*best.solution) : 0);
    if (!outcome.solution) {
      if (!best.solution) { return outcome; }
      Audit& audit = best.solution->audit;
      audit.interrupted = outcome.failure.kind == Failure::Kind::cancelled;
      if (outcome.failure.kind == Failure::Kind::out_of_memory) {
        audit.shortage = outcome.failure.sentences.empty() ? "no more memory" : outcome.failure.sentences.front();
      }
    } else {
      const Audit& audit = outcome.solution->audit;
      add_times(stages, audit.stages);
      const std::optional<ErrorEstimate> error = aimed_error(audit, options, of_picture);
      if (!error && !audit.interrupted) {
        return failed(
            Failure::Kind::invalid_options,
            {of_picture ? "no pixel of the picture shows reflected light whose paths end, so its error cannot be measured; aim at "
                          "the error over all surfaces, or give an epsilon instead of an error"
                        : "the error of this scene cannot be measured, for its paths do not end or meet no light; give an "
                          "epsilon instead of an error"});
      }
      const bool gained = !best_error || !error || error->relative_l2 < 0.95 * best_error->relative_l2;
      // Where noise hides the error nothing is known of it: a finer solution may cost a larger audit, which tells.
      const bool hidden = error && error->low <= 0.0;
      if (gained || !hidden) { without_gain = gained ? 0 : without_gain + 1; }
      // Finer where the error is: in the light of lamps, in the rest, or in both.
      const double direct = of_picture || !gained ? 0.5 : audit.direct_share.value_or(0.5);
      constexpr double step = 0.55;
      round.light_epsilon = (direct > 0.35 ? step : 1.0) * audit.light_epsilon;
      if (direct < 0.65) {
        round.epsilon *= step;
        round.min_area *= step * step;  // so does what the ends of shadows and contacts leave out
      }
      round.target *= 0.5;
      const bool floor =
          options.refinement == Refinement::a_priori ? round.epsilon < 1e-5 || *round.light_epsilon < 1e-6 : round.target < 1e-4;
      const bool over = audit.interrupted || !audit.shortage.empty() || audit.links > link_budget || floor || without_gain == 3;
      const bool met = error && error->within(wanted);
      if (!best.solution || !best_error || (error && !(best_error->high < error->low))) {
        best = std::move(outcome);
        best_error = error;
      }
      if (!met && !over) { continue; }
    }
    Audit& audit = best.solution->audit;
    const bool ended_early = audit.interrupted || !audit.shortage.empty();
    audit.target_missed = !ended_early && !(best_error && best_error->within(wanted));
    audit.converged = audit.converged && !ended_early && !audit.target_missed;
    audit.stages = std::move(stages);
    sum_times(audit);
    return best;
  }
}

}  // namespace detail

}  // namespace radiosity
