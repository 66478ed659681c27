// SPDX-License-Identifier: MIT
#pragma once

// What solve() does (radiosity.hpp): one run at a given fineness, and the rounds that meet an error target.
//
// A program of many files may compile this once: with HALFLIGHT_RADIOSITY_APART defined, radiosity.hpp only declares, and apart.cpp must be
// linked. By default everything is inline and nothing needs to be linked.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/link_error.hpp>
#include <radiosity/radiosity.hpp>

#ifndef HALFLIGHT_RADIOSITY_INLINE
#define HALFLIGHT_RADIOSITY_INLINE inline
#endif

namespace radiosity {

namespace detail {

// Their fractions are known to 1 %.
inline constexpr std::uint32_t stray_ray_count = 2500;

// One run at a given fineness.
inline Outcome solve_at(const Scene& scene, const Options& options, const Control& control) {
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
  solution.frame = frame;
  audit.channels = plan.channels;
  Hierarchy& hierarchy = solution.hierarchy;
  audit.warnings = warnings(scene, frame, boundary);
  cut_at_walls(boundary, objects.diameter());
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
  // Without light, or without reflection, B = E on the input faces.
  const bool needs_links = (plan.lit && plan.reflects) || !plan.shortcuts;
  if (needs_links && options.refinement == Refinement::a_posteriori) {
    BfResult bf = bf_refine(scene, objects, plan, reflectance, emission, boundary, hierarchy, patches, exposure, shown, evaluator,
                            options.target, Deadline{options.time}, link_limit, threads, options.seed, control);
    refined = std::move(bf.refined);
    evaluated = bf.evaluated;
    audit.estimated_error = bf.estimate;
    audit.target = options.time ? 0.0 : options.target;
    audit.generations = bf.generations;
    audit.interrupted = bf.interrupted;
  } else if (needs_links) {
    refined = refine(scene, objects, plan, boundary, hierarchy, patches, options.epsilon, options.min_area, audit.light_epsilon, threads,
                     options.seed, control);
  }
  if (refined.cancelled || evaluated.cancelled) { return cancelled(); }
  if (refined.too_many > 0) { return failed(Failure::Kind::invalid_options, {too_many_links(refined.too_many, clusters)}); }
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
  ColorSolution solved = solve_channels(hierarchy, transport, exposure.area, reflectance, emission, plan.channels, options.solver,
                                        options.residual, options.max_iterations);
  audit.residual = solved.residual;
  audit.iterations = solved.iterations;
  audit.converged = solved.converged && !audit.interrupted;
  audit.histories = std::move(solved.histories);
  solution.radiosity = std::move(solved.radiosity);
  if (needs_links && options.refinement == Refinement::a_priori && options.audit_points > 0) {
    audit.estimated_error =
        detail::sampled_estimate(evaluator, hierarchy, exposure, solution.links, reflectance, emission, solution.radiosity, threads);
  }
  balance_energy(audit, scene, inputs, hierarchy, transport, exposure.area, solution.radiosity);
  summarise_surfaces(audit, inputs, frame, hierarchy, exposure.area, solution.radiosity);
  watch.lap("solve");
  if (options.compare) {
    solution.comparison.emplace();
    if (exposed_leaves(hierarchy, exposure) <= *options.compare) {
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
  if (options.error && needs_links && options.refinement == Refinement::a_priori) {
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
  const bool picture = options.reconstruction != Reconstruction::none;
  if (!plan.lit || !plan.reflects) {
    audit.leaf_error = ErrorEstimate{};  // B = E is exact
    if (picture) { audit.picture_error = audit.leaf_error; }
  } else if (options.audit_points > 0 && plan.traceable && !control.cancelled()) {
    MeasuredError measured;
    const auto measure = [&](std::uint64_t points, MeasuredError& to) {
      measure_error(scene, objects, boundary, exposure, solution.mesh, direct ? &*direct : nullptr, points, threads, options.seed, to,
                    control);
      return !control.cancelled();
    };
    if (options.error) {
      // A ray of a path costs as much as two segments of links or two thirds of a link.
      const std::uint64_t solution_rays = (audit.rays + 3 * audit.links) / 2;
      decide_error(measure, picture ? &MeasuredError::picture : &MeasuredError::leaf, options.audit_points, *options.error, solution_rays,
                   std::max<std::uint64_t>(25'000'000, 2 * solution_rays), measured);
    } else {
      measure(options.audit_points, measured);
    }
    if (!control.cancelled()) {
      audit.leaf_error = measured.leaf.estimate();
      if (picture) { audit.picture_error = measured.picture.estimate(); }
      const double split = std::max(0.0, measured.direct) + std::max(0.0, measured.other);
      if (split > 0.0) { audit.direct_share = std::max(0.0, measured.direct) / split; }
      audit.audit_points = measured.points();
      audit.audit_rays = measured.rays;
    }
    watch.lap("audit");
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

}  // namespace detail

HALFLIGHT_RADIOSITY_INLINE Outcome solve(const Scene& scene, const Options& options, const Control& control) {
  std::vector<std::string> sentences = faults(options);
  if (!sentences.empty()) { return detail::failed(Failure::Kind::invalid_options, std::move(sentences)); }
  if (!options.error) { return detail::solve_at(scene, options, control); }
  const double wanted = *options.error;
  Options round = options;
  round.epsilon = 0.04;
  round.min_area = 3.84e-3;
  round.target = wanted;
  std::vector<StageTime> stages;
  Outcome before;
  double error_before = std::numeric_limits<double>::infinity();
  for (;;) {
    Outcome outcome = detail::solve_at(scene, round, control);
    if (!outcome.solution && outcome.failure.kind == Failure::Kind::cancelled && before.solution) {
      before.solution->audit.interrupted = true;
      before.solution->audit.converged = false;
      return before;
    }
    if (!outcome.solution) { return outcome; }
    Audit& audit = outcome.solution->audit;
    detail::add_times(stages, audit.stages);
    const std::optional<ErrorEstimate>& error = round.reconstruction != Reconstruction::none ? audit.picture_error : audit.leaf_error;
    const bool met = within(error, wanted);
    // Finer where the error is: in the light of lamps, in the rest, or in both; a smaller step where little is missing.
    const double direct = audit.direct_share.value_or(0.5);
    const bool stalled = error && error->relative_l2 > 0.8 * error_before;
    const double missing = error ? 0.8 * wanted / error->relative_l2 : 0.0;
    const double step = std::clamp(missing * missing, 0.5, 0.6);
    round.light_epsilon = (direct > 0.35 || stalled ? step : 1.0) * audit.light_epsilon;
    if (direct < 0.65 || stalled) {
      round.epsilon *= step;
      round.min_area *= step * step;  // so does what the ends of shadows and contacts leave out
    }
    round.target *= error ? std::clamp(0.7 * wanted / error->relative_l2, 0.25, 0.8) : 0.5;
    if (met || audit.interrupted || audit.links > 10'000'000 || round.epsilon < 1e-5 || *round.light_epsilon < 1e-6 ||
        round.target < 1e-6) {
      audit.converged = audit.converged && met;
      audit.stages = std::move(stages);
      detail::sum_times(audit);
      return outcome;
    }
    error_before = error ? error->relative_l2 : error_before;
    before = std::move(outcome);
    before.solution->audit.stages = stages;
    detail::sum_times(before.solution->audit);
  }
}

}  // namespace radiosity
