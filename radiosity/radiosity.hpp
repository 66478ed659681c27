// SPDX-License-Identifier: MIT
#pragma once

// The facade: a scene goes in, a mesh with radiosities and the audit of the run come out.
//
//   objects -> one BRep an object -> roots -> refine (oracle) -> expose -> evaluate links -> solve -> reconstruct -> audit
//
// Data flows one way; the objects stay untouched. The library prints nothing, opens no file and throws nothing.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/audit.hpp>
#include <radiosity/bf_refine.hpp>
#include <radiosity/cluster_choice.hpp>
#include <radiosity/clusters.hpp>
#include <radiosity/comparison.hpp>
#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/mesh.hpp>
#include <radiosity/options.hpp>
#include <radiosity/polygons.hpp>
#include <radiosity/prepare.hpp>
#include <radiosity/reconstruct.hpp>
#include <radiosity/refine.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/solve.hpp>
#include <radiosity/summary.hpp>
#include <radiosity/transport.hpp>
#include <radiosity/wall_cuts.hpp>
#include <radiosity/warnings.hpp>

namespace radiosity {

struct Solution {
  Mesh mesh;  // positions in the scene's own coordinates
  Audit audit;

  // What stands behind the mesh, in the coordinates of the frame.
  Frame frame;
  Hierarchy hierarchy;
  Links links;
  std::vector<double> area;      // exposed, one a node
  std::vector<double> row_sum;   // of the system that was solved, one a node; 0 at inner nodes
  std::vector<Color> radiosity;  // W/m2, one a node

  std::optional<Comparison> comparison;  // when asked for
};

struct Failure {
  enum class Kind { invalid_scene, invalid_options, cancelled };
  Kind kind = Kind::invalid_scene;
  std::vector<std::string> sentences;
};

struct Outcome {
  std::optional<Solution> solution;
  Failure failure;  // when there is no solution
};

namespace detail {

// Measures the wall and CPU time of stages that follow one another.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& stages) : stages_{&stages} {}

  // Ends the stage that began with the last call (or the construction).
  void lap(std::string name) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    stages_->push_back(
        {std::move(name), std::chrono::duration<double>(wall - wall_).count(), static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC});
    wall_ = wall;
    cpu_ = cpu;
  }

 private:
  std::vector<StageTime>* stages_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// Adds the times of one round to those of the rounds before it, stage by stage.
inline void add_times(std::vector<StageTime>& total, const std::vector<StageTime>& round) {
  for (const StageTime& stage : round) {
    auto same = std::find_if(total.begin(), total.end(), [&](const StageTime& t) { return t.name == stage.name; });
    if (same == total.end()) { same = total.insert(same, {stage.name, 0.0, 0.0}); }
    same->wall_seconds += stage.wall_seconds;
    same->cpu_seconds += stage.cpu_seconds;
  }
}

// The total, of which neither the audit nor a comparison is a part.
inline void sum_times(Audit& audit) {
  audit.wall_seconds = 0.0;
  audit.cpu_seconds = 0.0;
  for (const StageTime& stage : audit.stages) {
    if (stage.name == "audit" || stage.name == "compare") { continue; }
    audit.wall_seconds += stage.wall_seconds;
    audit.cpu_seconds += stage.cpu_seconds;
  }
}

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

// The largest RMS correction by which a scene is closed: what its links explain (doubt.hpp) with a margin of one half, and the error
// of a form factor (exchange.hpp). Measured, corrections are .24 to 1.16 times what is expected (the rooms of `halflight stress`, 1200 to 154 000 links).
[[nodiscard]] inline double explained_closure(const DoubtSum& doubt, const std::vector<double>& exposed_area, const Hierarchy& hierarchy) {
  double total = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { total += hierarchy[i].parent == no_node ? exposed_area[i] : 0.0; }
  return 1.5 * doubt.rms(exposed_area, total) + 2e-5;
}

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
  audit.warnings = warnings(scene, frame, objects, boundary);
  cut_at_walls(boundary, objects.diameter());
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

  std::vector<bool> emits;
  std::vector<std::uint32_t> materials;
  std::vector<Color> reflectance;
  std::vector<Color> emission;
  for (const InputSurface& input : inputs) {
    const Material& material = scene.materials[input.material];
    emits.push_back(!is_black(material.emission));
    materials.push_back(input.material);
    reflectance.push_back(material.reflectance);
    emission.push_back(material.emission);
  }
  Exposure exposure;
  Patches patches{boundary, hierarchy};
  ShownAreas shown;
  const LinkEvaluator evaluator{objects, plan, hierarchy, patches, exposure, shown, emits, options.seed};
  RefineResult refined;
  EvaluateResult evaluated;
  // Without light, or without reflection, B = E on the input faces.
  const bool needs_links = (plan.lit && plan.reflects) || !plan.shortcuts;
  if (needs_links && options.refinement == Refinement::a_posteriori) {
    BfResult bf = bf_refine(scene, objects, plan, reflectance, emission, boundary, hierarchy, patches, exposure, evaluator, options.target,
                            Deadline{options.time}, link_limit, threads, options.seed, control);
    refined = std::move(bf.refined);
    evaluated = bf.evaluated;
    audit.estimated_error = bf.estimate;
    audit.target = options.time ? 0.0 : options.target;
    audit.generations = bf.generations;
    audit.interrupted = bf.interrupted;
  } else if (needs_links) {
    refined =
        refine(scene, objects, plan, boundary, hierarchy, patches, options.epsilon, options.min_area, true, threads, options.seed, control);
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
    audit.closure_limit = detail::explained_closure(evaluated.doubt, exposure.area, hierarchy);
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

  const bool constant = options.reconstruction == Reconstruction::constant;
  const bool cut = (!constant || !plan.shortcuts) && eliminate_t_vertices(boundary) > 0;
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
  if (!plan.lit || !plan.reflects) {
    audit.leaf_error = audit.picture_error = ErrorEstimate{};  // B = E is exact
  } else if (options.audit_points > 0 && plan.traceable && !control.cancelled()) {
    const MeasuredError measured =
        measure_error(scene, objects, boundary, exposure, solution.mesh, options.audit_points, threads, options.seed, control);
    if (!control.cancelled()) {
      audit.leaf_error = measured.leaf;
      audit.picture_error = measured.picture;
      audit.audit_points = measured.points;
      audit.audit_rays = measured.rays;
    }
    watch.lap("audit");
  }
  if (options.audit_points > 0 && needs_links && plan.traceable && !audit.picture_error && control.cancelled()) {
    audit.interrupted = true;
    audit.left_out.push_back({"the error estimate", "the run was interrupted", ""});
  }
  sum_times(audit);
  for (glm::dvec3& p : solution.mesh.positions) { p = frame.to_scene(p); }
  solution.area = exposure.area;
  return {std::move(solution), {}};
}

}  // namespace detail

// Solves the scene. With an error target the run starts coarse and refines until the audit of the picture witnesses the target, twice its
// standard error included; times are those of all rounds together. A run whose error stays above says so by audit.converged; it gives up
// before it would need more than 20 million links (480 MB).
[[nodiscard]] inline Outcome solve(const Scene& scene, const Options& options = {}, const Control& control = {}) {
  std::vector<std::string> sentences = faults(options);
  if (!sentences.empty()) { return detail::failed(Failure::Kind::invalid_options, std::move(sentences)); }
  if (!options.error) { return detail::solve_at(scene, options, control); }
  const double wanted = *options.error;
  Options round = options;
  round.epsilon = 0.04;
  round.min_area = 2.4e-4;
  round.target = wanted;
  std::vector<StageTime> stages;
  Outcome before;
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
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const ErrorEstimate error = audit.picture_error.value_or(ErrorEstimate{unknown, unknown});
    const bool met = error.relative_l2 + 2.0 * error.standard_error <= wanted;
    // An estimate that drowns in its own noise needs more points; else, and in any case where noise is not to blame, a finer mesh.
    const bool noisy = error.standard_error > 0.25 * wanted && round.audit_points < 200'000;
    if (noisy) { round.audit_points *= 4; }
    if (!noisy || error.relative_l2 > 0.5 * wanted) {
      round.epsilon *= 0.5;
      round.min_area *= 0.5;
      round.target *= std::clamp(0.7 * wanted / error.relative_l2, 0.25, 0.8);
    }
    if (met || audit.interrupted || 4 * audit.links > 20'000'000 || round.epsilon < 1e-5 || round.target < 1e-6) {
      audit.converged = audit.converged && met;
      audit.stages = std::move(stages);
      detail::sum_times(audit);
      return outcome;
    }
    before = std::move(outcome);
    before.solution->audit.stages = stages;
    detail::sum_times(before.solution->audit);
  }
}

}  // namespace radiosity
