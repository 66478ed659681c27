// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/matrix/dense.hpp>
#include <radiosity/picture/make_mesh.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>

#include <raycast/inline.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/summary.hpp>
#include <radiosity/audit/surface_error.hpp>
#include <radiosity/audit/warnings.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/geometry/directions.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/long_faces.hpp>
#include <radiosity/hierarchy/polygons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/saving.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/refinement/bf_refine.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/refinement/refine.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// Their fractions are known to 1 %.
inline constexpr std::uint32_t stray_ray_count = 2500;

// Fills in the errors of the solution, whose mesh is still in the frame.
HALFLIGHT_INLINE void measure_errors(const Options& options, const Control& control, SurfaceErrorMeter meter, unsigned threads,
                                     Solution& solution) {
  Audit& audit = solution.audit;
  const AuditGoal to_know = goal_to_know(audit, options.audit_points);
  const std::uint64_t solution_rays = rays_worth(audit);
  AuditGoal goal = to_know;
  if (options.error) {
    goal = {options.audit_points, solution_rays, *options.error, std::max<std::uint64_t>(25'000'000, 2 * solution_rays)};
  }
  if (options.error && control.picture_error) {
    Mesh shown = solution.mesh;
    for (glm::dvec3& p : shown.positions) { p = solution.frame.to_scene(p); }
    audit.picture_error = control.picture_error(shown, solution.frame, goal);
    // The error over all surfaces decides nothing then: until the picture is good enough, a little of it will do.
    const bool last = audit.picture_error && audit.picture_error->error.within(*options.error);
    goal = last ? to_know : AuditGoal{options.audit_points / 4, solution_rays / 2};
  }
  const bool reconstructed = options.reconstruction != Reconstruction::none;
  const auto measure = [&](std::uint64_t points, std::uint32_t paths, SurfaceError& to) {
    return meter.measure(points, paths, threads, control, to);
  };
  SurfaceError measured;
  const bool complete = measure_to_goal<SurfaceError>(
      measure, [&](const SurfaceError& error) -> const ErrorSums& { return reconstructed ? error.reconstructed : error.leaf; }, goal,
      measured);
  if (!complete) { return; }
  audit.leaf_error = measured.leaf.estimate();
  if (reconstructed) { audit.surface_error = measured.reconstructed.estimate(); }
  audit.audit_points = measured.points();
  audit.audit_rays = measured.rays;
  if (!options.error || control.picture_error) { return; }
  // What steers the next round must not depend on the target: as many rays as the solution took, at most.
  SurfaceError steering;
  constexpr std::uint64_t points = 256;
  const auto paths = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(solution_rays / (points * 8), 4, 64));
  if (!measure(points, paths, steering)) { return; }
  const double split = std::max(0.0, steering.direct) + std::max(0.0, steering.other);
  if (split > 0.0) { audit.direct_share = std::max(0.0, steering.direct) / split; }
}

// One run at a given fineness. `budget`: its limits are set; what is fixed becomes known here.
HALFLIGHT_INLINE Outcome solve_at(const Scene& scene, const Options& options, const Control& control, MemoryBudget budget) {
  Solution solution;
  Audit& audit = solution.audit;
  Stopwatch watch{audit.stages};
  const unsigned threads = thread_count(options.threads);
  audit.epsilon = options.epsilon;
  audit.min_area = options.min_area;
  audit.light_epsilon = options.light_epsilon.value_or(0.25 * options.epsilon);
  audit.threads = threads;
  audit.seed = options.seed;
  const auto cancelled = [] { return failed(Failure::Kind::cancelled, {"the run was interrupted before there was a solution"}); };

  PrepareResult preparation = prepare(scene, options.shortcuts);
  if (!preparation.prepared) { return failed(Failure::Kind::invalid_scene, std::move(preparation.faults)); }
  const Frame frame = preparation.prepared->frame;
  const raycast::Scene& objects = preparation.prepared->objects;
  std::vector<Surface>& boundary = preparation.prepared->surfaces;
  if (options.topology == Topology::separate) {
    for (Surface& surface : boundary) { surface = separate_polygons(surface); }
  }
  const Plan& plan = preparation.prepared->plan;
  const std::vector<InputSurface> inputs = surfaces(scene);
  const PathTracer tracer{scene, objects, boundary};
  solution.frame = frame;
  audit.channels = plan.channels;
  Hierarchy& hierarchy = solution.hierarchy;
  audit.warnings = warnings(scene, frame, boundary);
  if (const std::size_t left = cut_at_walls(boundary, objects.diameter())) { audit.warnings.push_back(warning_of_uncut(left)); }
  cut_long_faces(boundary, options.min_area);
  hierarchy = make_roots(boundary);
  const ClusterChoice clusters = choose_clusters(hierarchy.size(), options);
  if (clusters.build) { hierarchy = make_clusters(boundary, hierarchy); }
  audit.clusters =
      static_cast<std::uint64_t>(std::count_if(hierarchy.begin(), hierarchy.end(), [](const Node& n) { return n.is_cluster(); }));
  if (plan.lossless) {
    return failed(Failure::Kind::invalid_scene, {"the scene is closed and nothing in it absorbs light in some channel in which it emits: "
                                                 "the light would grow without end; give some surface a reflectance below 1"});
  }
  watch.lap("build");

  std::vector<std::uint32_t> materials;
  std::vector<Color> reflectance;
  std::vector<Color> emission;
  for (const InputSurface& input : inputs) {
    const Material& material = scene.materials[input.material];
    materials.push_back(input.material);
    reflectance.push_back(material.reflectance);
    emission.push_back(material.emission);
  }
  Exposure exposure;
  Patches patches{boundary, hierarchy};
  ShownAreas shown;
  const LinkEvaluator evaluator{objects, plan, hierarchy, patches, exposure, shown, options.seed};
  RefineResult refined;
  EvaluateResult evaluated;
  double unseen = 0.0;  // part of the estimate
  // Without light, or without reflection, B = E on the input faces.
  const bool needs_links = (plan.lit && plan.reflects) || !plan.shortcuts;
  budget.a_posteriori = options.refinement == Refinement::a_posteriori;
  budget.fixed = objects.bytes() + audit.clusters * 8 * direction_count * sizeof(double) + std::uint64_t{options.audit_points} * 150;
  for (const Surface& surface : boundary) { budget.fixed += surface.brep.bytes(); }
  const auto too_large = [&](std::uint64_t needed) {
    return too_much_memory(needed, budget.allowed,
                           options.error ? "a larger error needs less"
                           : budget.a_posteriori
                               ? "a larger target needs less"
                               : "a larger epsilon or min_area needs less, and BF-refinement ends with the best that fits");
  };
  if (needs_links && options.refinement == Refinement::a_posteriori) {
    BfResult bf =
        bf_refine(scene, objects, plan, reflectance, emission, boundary, hierarchy, patches, exposure, shown, evaluator, options.target,
                  detail::leaf_part(options.reconstruction), Deadline{options.time}, link_limit, threads, options.seed, control, budget);
    refined = std::move(bf.refined);
    evaluated = bf.evaluated;
    audit.estimated_error = bf.estimate;
    audit.estimated_leaf_error = bf.leaf_estimate;
    unseen = bf.unseen;
    audit.target = options.time ? 0.0 : options.target;
    audit.generations = bf.generations;
    audit.interrupted = bf.interrupted;
    if (bf.too_large > 0 && bf.estimate > options.target) { audit.shortage = too_large(bf.too_large); }
  } else if (needs_links) {
    refined = refine(scene, objects, plan, boundary, hierarchy, patches, options.epsilon, options.min_area, audit.light_epsilon, threads,
                     options.seed, control, budget);
  }
  if (refined.cancelled || evaluated.cancelled) { return cancelled(); }
  if (refined.too_many > 0) { return failed(Failure::Kind::invalid_options, {too_many_links(refined.too_many, clusters)}); }
  if (refined.too_large > 0) { return failed(Failure::Kind::out_of_memory, {too_large(refined.too_large)}); }
  if (!needs_links && !budget.allows({hierarchy.size()})) {
    return failed(Failure::Kind::out_of_memory, {too_large(budget.peak({hierarchy.size()}))});
  }
  solution.links = std::move(refined.links);
  watch.lap("refine");

  patches.extend(threads);
  extend(exposure, objects, boundary, hierarchy, patches, threads, options.seed);
  if (exposure.all_buried) {
    return failed(Failure::Kind::invalid_scene,
                  {"every surface is buried under another object: nothing can be seen. Two rooms made by 'inside' "
                   "that do not overlap bury each other, for beyond its walls a room is solid"});
  }
  for (std::string& sentence : warnings_of_buried(scene, hierarchy, exposure)) { audit.warnings.push_back(std::move(sentence)); }
  if (!plan.closed && needs_links) {
    audit.stray = stray_rays(objects, boundary, hierarchy, patches, exposure, stray_ray_count, threads, options.seed);
  }
  watch.lap("expose");

  if (needs_links && options.refinement == Refinement::a_priori) {
    if (clusters.build) {
      shown = ShownAreas{hierarchy, [&](std::size_t i) { return exposure.area[i]; }};
    }
    evaluated = evaluate(evaluator, refined.occluders, solution.links, refined.lists, 0, nullptr, threads, control);
    if (evaluated.cancelled) { return cancelled(); }
  }
  watch.lap("link");

  Transport transport{hierarchy, solution.links, exposure, threads};
  solution.row_sum = transport.row_sums();
  audit.computed_row_sum = summarise_rows(hierarchy, exposure.area, solution.row_sum);
  if (plan.closed && !solution.links.empty()) {
    double exposed = 0.0;
    for (std::size_t i = 0; i < hierarchy.size(); ++i) { exposed += hierarchy[i].parent == no_node ? exposure.area[i] : 0.0; }
    audit.closure_limit = explained_closure(evaluated.doubt, exposure.area, exposed);
    audit.closure = transport.close(audit.closure_limit);
  }
  solution.row_sum = transport.row_sums();
  audit.row_sum = summarise_rows(hierarchy, exposure.area, solution.row_sum);
  const auto solve_by = [&](Solver solver, const Control& until) {
    return solve_channels(hierarchy, transport, exposure.area, reflectance, emission, plan.channels, solver, options.residual,
                          options.max_iterations, until);
  };
  ColorSolution solved = solve_by(options.solver, control);
  if (solved.cancelled) {  // all links are there: the solution by the fewest iterations is near
    audit.interrupted = true;
    solved = solve_by(Solver::conjugate_gradients, control.unstoppable());
  }
  audit.residual = solved.residual;
  audit.iterations = solved.iterations;
  audit.converged = solved.converged && !audit.interrupted && audit.shortage.empty();
  audit.histories = std::move(solved.histories);
  solution.radiosity = std::move(solved.radiosity);
  if (needs_links && options.refinement == Refinement::a_priori && options.audit_points > 0) {
    const detail::ErrorEstimation errors = detail::sampled_estimate(evaluator, hierarchy, patches, exposure, solution.links, reflectance,
                                                                    emission, solution.radiosity, evaluated.doubt, threads);
    audit.estimated_error = errors.relative(detail::leaf_part(options.reconstruction));
    audit.estimated_leaf_error = errors.relative(1.0);
  }
  if (audit.estimated_error) {
    audit.estimate_doubt = detail::estimate_doubt(hierarchy, exposure, transport, reflectance, emission, solution.radiosity, unseen,
                                                  audit.closure.has_value());
  }
  balance_energy(audit, scene, inputs, hierarchy, transport, exposure.area, solution.radiosity);
  summarise_surfaces(audit, inputs, frame, hierarchy, exposure.area, solution.radiosity);
  watch.lap("solve");
  if (options.compare) {
    solution.comparison.emplace();
    const std::uint64_t leaves = exposed_leaves(hierarchy, exposure);
    const std::uint64_t matrix = 8 * leaves * leaves;
    if (leaves <= *options.compare && budget.allows({hierarchy.size(), solution.links.size(), 0, matrix / 2})) {
      const LeafExchange exchange{objects, plan, boundary, hierarchy, patches, exposure, evaluator};
      solution.comparison->dense = dense_radiosity(exchange, leaf_materials(exchange, hierarchy, reflectance, emission), plan.closed,
                                                   hierarchy.size(), options.residual, threads, control);
    }
    if (control.cancelled()) { return cancelled(); }
    watch.lap("compare");
  }

  const bool constant = options.reconstruction >= Reconstruction::constant;
  const bool cut = (!constant || !plan.shortcuts) && eliminate_t_vertices(boundary) > 0;
  std::optional<Mesh> direct;  // of the light that was reflected once: one step from E
  if (options.error && !control.picture_error && needs_links && options.refinement == Refinement::a_priori) {
    const ColorSolution once =
        solve_channels(hierarchy, transport, exposure.area, reflectance, emission, plan.channels, Solver::jacobi, options.residual, 1);
    reconstruct(boundary, hierarchy, exposure, once.radiosity, materials, options.reconstruction);
    direct = make_mesh(boundary, hierarchy, exposure, once.radiosity);
  }
  reconstruct(boundary, hierarchy, exposure, solution.radiosity, materials, options.reconstruction);
  solution.mesh = make_mesh(boundary, hierarchy, exposure, solution.radiosity);
  watch.lap("reconstruct");
  if (solution.comparison) {
    reconstruct(boundary, hierarchy, exposure, solution.radiosity, materials, other(options.reconstruction));
    solution.comparison->other = make_mesh(boundary, hierarchy, exposure, solution.radiosity);
    for (glm::dvec3& p : solution.comparison->other.positions) { p = frame.to_scene(p); }
    watch.lap("compare");
  }

  for (std::size_t i = 0; i < hierarchy.size(); ++i) { audit.polygons += is_input_face(hierarchy, i) ? 1 : 0; }
  audit.nodes = hierarchy.size();
  audit.leaves = static_cast<std::uint64_t>(std::count_if(hierarchy.begin(), hierarchy.end(), [](const Node& n) { return n.leaf(); }));
  audit.links = solution.links.size();
  audit.cluster_links = static_cast<std::uint64_t>(std::count_if(solution.links.begin(), solution.links.end(), [&](const Link& link) {
    return hierarchy[link.p].is_cluster() || hierarchy[link.q].is_cluster();
  }));
  audit.proportion = summarise_proportions(hierarchy, patches);
  RayCount rays = refined.rays;
  rays += evaluated.rays;
  audit.rays = rays.cast;
  audit.rays_avoided = rays.avoided + refined.pairs_hidden * segments_per_round;
  audit.pairs_clear = evaluated.proven_clear;
  audit.pairs_hidden = refined.pairs_hidden;
  audit.bytes = hierarchy.capacity() * sizeof(Node) + solution.links.capacity() * sizeof(Link) + objects.bytes();
  for (const Surface& surface : boundary) { audit.bytes += surface.brep.bytes(); }
  report_left_out(audit, plan, refined, evaluated, exposure, options, link_cost(evaluator, solution.links));
  if (!cut && !constant && options.topology == Topology::shared) {
    audit.left_out.push_back({"T-vertex elimination", "no leaf has a finer neighbour", ""});
  }
  if (needs_links && !clusters.build) { audit.left_out.push_back({"clusters above the input faces", clusters.why, ""}); }
  if (plan.closed && !solution.links.empty() && !audit.closure) {
    audit.left_out.push_back({"closing the scene", "its row sums need a larger correction than quadrature and sampling explain", ""});
  }
  const bool reconstructed = options.reconstruction != Reconstruction::none;
  if (!plan.lit || !plan.reflects) {
    audit.leaf_error = ErrorEstimate{};  // B = E is exact
    if (reconstructed) { audit.surface_error = audit.leaf_error; }
    if (control.picture_error) { audit.picture_error = PictureError{}; }
  } else if (options.audit_points > 0 && plan.traceable && !control.cancelled()) {
    measure_errors(options, control,
                   SurfaceErrorMeter{scene, objects, tracer, exposure, solution.mesh, direct ? &*direct : nullptr, options.seed}, threads,
                   solution);
    watch.lap("audit");
  }
  if (needs_links && options.refinement == Refinement::a_posteriori && !options.time && !options.error) {
    const std::optional<ErrorEstimate>& error = reconstructed ? audit.surface_error : audit.leaf_error;
    const bool contradicted = error && error->above(options.target);
    audit.target_missed = !(*audit.estimated_error <= options.target) || contradicted;
    audit.converged = audit.converged && !audit.target_missed;
  }
  if (options.audit_points > 0 && needs_links && plan.traceable && !audit.leaf_error && control.cancelled()) {
    audit.interrupted = true;
    audit.left_out.push_back({"the error estimate", "the run was interrupted", ""});
  }
  sum_times(audit);
  for (glm::dvec3& p : solution.mesh.positions) { p = frame.to_scene(p); }
  solution.area = exposure.area;
  return {std::move(solution), {}};
}

HALFLIGHT_INLINE Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held) {
  MemoryBudget budget;
  if (options.memory) { budget.allowed = *options.memory - std::min(*options.memory, held); }
  std::uint32_t solved = 0;  // generations of BF-refinement
  budget.solved = &solved;
  Outcome outcome = unless_out_of_memory([&] { return solve_at(scene, options, control, budget); });
  while (!outcome.solution && outcome.failure.kind == Failure::Kind::out_of_memory && solved > 0 && budget.last_generation > 0) {
    budget.last_generation = std::min(budget.last_generation, std::exchange(solved, 0)) - 1;
    outcome = unless_out_of_memory([&] {
      Outcome coarser = solve_at(scene, options, control, budget);
      if (coarser.solution) {
        coarser.solution->audit.shortage = "the system had no more memory for a finer solution; a larger target or error needs less";
        coarser.solution->audit.converged = false;
      }
      return coarser;
    });
  }
  return outcome;
}

}  // namespace detail

}  // namespace radiosity
