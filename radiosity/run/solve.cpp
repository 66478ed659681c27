// SPDX-License-Identifier: MIT

// Stage: closes the row sums and solves the linear system.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/audit/summary.hpp>
#include <radiosity/audit/warnings.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/refinement/closed_nodes.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

// Adds the links of stored rays, scaled to better estimates of their row sums. Returns the row sums before scaling.
// `error_of_lamps`: expected RMS error of the lamps' row sums.
HALFLIGHT_INLINE std::vector<double> add_ray_links(Run& run, double error_of_lamps) {
  const bool closed = run.scene.any_closed();
  const RayLinks& made = run.ray_links;
  if (closed) { run.transport->scale_lamps(); }
  const std::vector<double> of_lamps = run.transport->row_sums();
  run.solution.ray_links = std::move(run.ray_links.links);
  run.transport->add_sampled(run.solution.ray_links);
  const std::vector<double> computed = run.transport->row_sums();
  std::vector<double> of_rays;
  for (std::size_t i = 0; i < computed.size(); ++i) { of_rays.push_back(computed[i] - of_lamps[i]); }
  const std::vector<double> wanted = made.row_sums(run.scene, *run.transport, run.solution.ray_links, of_rays, of_lamps, error_of_lamps);
  run.solution.audit.ray_correction = run.transport->scale_sampled(wanted, closed ? scales_of_closed : scales_of_open);
  return computed;
}

// Makes the operator of the linear system, and corrects the row sums of a closed scene as far as quadrature and sampling explain the
// deviation.
HALFLIGHT_INLINE void make_transport(Run& run) {
  const DiscreteScene& scene = run.scene;
  Solution& solution = run.solution;
  Audit& audit = run.solution.audit;
  ClosedNodes closed = closed_nodes(scene, solution.links);
  Transport& transport = run.transport.emplace(scene.hierarchy, solution.links, scene.exposure, scene.threads, std::move(closed));
  const std::vector<double>& area = scene.exposure.area;
  double exposed = 0.0;
  for (std::size_t i = 0; i < scene.hierarchy.size(); ++i) { exposed += scene.hierarchy[i].parent == no_node ? area[i] : 0.0; }
  const double error = run.evaluated.doubt.rms(scene.hierarchy, area, exposed);
  audit.computed_row_sum = summarise_rows(scene.hierarchy, area, run.rays.cast ? add_ray_links(run, error) : transport.row_sums());
  if (scene.any_closed() && solution.links.size() + solution.ray_links.size() > 0) {
    // By now the noise of rays has been removed from the row sums.
    audit.closure_limit = explained_closure(run.evaluated.doubt, scene.hierarchy, area, exposed);
    audit.closure = transport.close(audit.closure_limit);
  }
  solution.row_sum = transport.row_sums();
  audit.overfull = overfull_share(scene.hierarchy, area, solution.row_sum);
  if (audit.overfull > 0.0) {
    transport.limit_row_sums(solution.row_sum, most_row_sum);
    solution.row_sum = transport.row_sums();
  }
  audit.row_sum = summarise_rows(scene.hierarchy, area, solution.row_sum);
}

// Returns false if no solution was found: there may be none.
[[nodiscard]] HALFLIGHT_INLINE bool solve_system(Run& run) {
  const DiscreteScene& scene = run.scene;
  Audit& audit = run.solution.audit;
  const auto solve_by = [&](Solver solver, const Control& until) {
    return solve_channels(*run.transport, run.transport->area(), surface_light(scene),
                          {solver, run.options.residual, run.options.max_iterations}, until);
  };
  ColorSolution solved = solve_by(audit.interrupted ? Solver::conjugate_gradients : run.options.solver, scene.control);
  if (solved.cancelled) {  // all links exist, so the solver with the fewest iterations finishes quickly
    audit.interrupted = true;
    solved = solve_by(Solver::conjugate_gradients, scene.control.unstoppable());
  }
  audit.residual = solved.residual;
  audit.iterations = solved.iterations;
  audit.converged = solved.converged && !audit.interrupted && audit.shortage.empty();
  audit.histories = std::move(solved.histories);
  run.solution.radiosity = std::move(solved.radiosity);
  return solved.converged;
}

// Lamps of a cluster that reflect and are very close to each other, as the blades of a glowing louvre, may still have row sums so large
// that their light grows without end: no steady state. Then each of them is limited. Returns false if this changes nothing.
HALFLIGHT_INLINE bool limit_lamps_apart(Run& run) {
  const DiscreteScene& scene = run.scene;
  std::vector<double>& rows = run.solution.row_sum;
  if (!(overfull_share(scene.hierarchy, scene.exposure.area, rows) > 0.0)) { return false; }
  run.transport->limit_row_sums(rows, most_row_sum, true);
  rows = run.transport->row_sums();
  run.solution.audit.row_sum = summarise_rows(scene.hierarchy, scene.exposure.area, rows);
  return true;
}

// BF-refinement has estimated the error already; for F-refinement it is estimated now.
HALFLIGHT_INLINE void estimate_error(Run& run) {
  const DiscreteScene& scene = run.scene;
  const Solution& solution = run.solution;
  Audit& audit = run.solution.audit;
  if (run.f_refined() && run.options.audit_points > 0) {
    ErrorEstimation errors = sampled_estimate(scene, {solution.links, solution.ray_links}, solution.radiosity, run.evaluated);
    if (run.rays.cast) { errors.of_links += run.ray_links.noise(scene, solution.ray_links, solution.radiosity); }
    audit.estimated_error = errors.relative(leaf_part(run.options.reconstruction));
    audit.estimated_leaf_error = errors.relative(1.0);
    run.unseen = errors.sum(1.0) > 0.0 ? errors.unseen / errors.sum(1.0) : 0.0;
  }
  if (audit.estimated_error) {
    audit.estimate_doubt =
        estimate_doubt(scene, *run.transport, solution.radiosity, *audit.estimated_leaf_error, run.unseen, audit.closure.has_value());
  }
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> solve(detail::Run& run) {
  const DiscreteScene& scene = run.scene;
  Audit& audit = run.solution.audit;
  detail::make_transport(run);
  const bool solved = detail::solve_system(run);
  if (!solved && !run.stopped() && detail::limit_lamps_apart(run)) { static_cast<void>(detail::solve_system(run)); }
  detail::estimate_error(run);
  balance_energy(audit, scene, *run.transport, run.solution.radiosity);
  if (std::string sentence = warning_of_lost_light(scene, run.solution.radiosity); !sentence.empty()) {
    audit.warnings.push_back(std::move(sentence));
  }
  summarise_surfaces(audit, scene, run.solution.radiosity);
  run.watch.lap("solve");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
