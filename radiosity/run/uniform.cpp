// SPDX-License-Identifier: MIT
#include <radiosity/run/uniform.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/polygons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/matrix/dense.hpp>
#include <radiosity/matrix/gather_lists.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/own_unit.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

// The options of a hierarchical run, for the stages used here.
HALFLIGHT_INLINE Options options_of(const UniformOptions& uniform) {
  Options options;
  options.residual = uniform.residual;
  options.reconstruction = uniform.reconstruction;
  options.compare = uniform.compare;
  options.threads = uniform.threads;
  options.memory = uniform.memory;
  options.seed = uniform.seed;
  return options;
}

HALFLIGHT_INLINE std::optional<Failure> interrupted() { return Failure{Failure::Kind::cancelled, {"the run was interrupted"}}; }

// Replaces refinement: cuts every input face evenly.
HALFLIGHT_INLINE std::optional<Failure> build_evenly(Run& run, const UniformOptions& options) {
  DiscreteScene& scene = run.scene;
  if (!(options.max_area > 0.0)) { return Failure{Failure::Kind::invalid_options, {"max_area must be above 0"}}; }
  if (std::optional<Failure> failure = run.prepare_scene()) { return failure; }
  if (scene.plan.lossless) {
    return Failure{Failure::Kind::invalid_scene, {"closed, and nothing in it absorbs light: there is no solution"}};
  }
  run.solution.audit.left_out = scene.plan.left_out;
  cut_at_walls(scene.surfaces, scene.objects.diameter(), most_wall_pairs, scene.emission);
  scene.hierarchy = make_roots(scene.surfaces);
  run.watch.lap("build");

  const double total = root_area(scene.hierarchy);
  if (scene.hierarchy.size() > options.max_leaves || 1.0 / options.max_area > options.max_leaves) {
    return Failure{Failure::Kind::invalid_options,
                   {"more than " + std::to_string(options.max_leaves) + " leaves; a larger max_area needs fewer"}};
  }
  split_evenly(scene.surfaces, scene.hierarchy, options.max_area * total);
  run.watch.lap("refine");
  scene.expose();
  run.watch.lap("expose");
  return std::nullopt;
}

// Checks the number of leaves and the memory; `tables`: bytes held by the solver.
HALFLIGHT_INLINE std::optional<Failure> check_size(Run& run, const UniformOptions& options, std::uint64_t leaves, std::uint64_t tables) {
  if (leaves > options.max_leaves) {
    return Failure{Failure::Kind::invalid_options, {std::to_string(leaves) + " leaves; a larger max_area needs fewer"}};
  }
  MemoryBudget& budget = run.scene.budget;
  budget.fixed = run.scene.objects.bytes() + tables;
  if (!budget.allows({run.scene.hierarchy.size()})) {
    return Failure{Failure::Kind::out_of_memory,
                   {too_much_memory(budget.peak({run.scene.hierarchy.size()}), budget, "a larger max_area needs less")}};
  }
  return std::nullopt;
}

HALFLIGHT_INLINE void report(Run& run, const DenseSolution& solved) {
  Audit& audit = run.solution.audit;
  audit.iterations = static_cast<std::uint32_t>(solved.iterations);
  audit.residual = solved.residual;
  audit.converged = solved.converged;
  audit.rays = solved.rays.cast;
  audit.rays_avoided = solved.rays.avoided;
  run.watch.lap("solve");
}

// Replaces links: all exchanges between leaves, stored in a matrix or computed shot by shot.
HALFLIGHT_INLINE std::optional<Failure> solve_leaves(Run& run, const UniformOptions& options, const LeafExchange& exchange,
                                                     const LeafMaterials& leaves) {
  const DiscreteScene& scene = run.scene;
  Audit& audit = run.solution.audit;
  const std::uint64_t n = exchange.size();
  DenseSolution solved;
  if (options.solver == UniformSolver::gauss_seidel) {
    DenseMatrix matrix = make_matrix(exchange, scene.threads, scene.control);
    run.watch.lap("link");
    if (scene.plan.closed) {
      audit.closure_limit = explained_closure(matrix, exchange);
      audit.closure = close_rows(matrix, exchange, audit.closure_limit);
    }
    solved = gauss_seidel(matrix, exchange, leaves, options.residual, 1000, scene.control);
    solved.rays = matrix.rays;
    audit.links = n * n;
    audit.bytes = matrix.entry.capacity() * sizeof(float);
  } else {
    solved = shoot(exchange, leaves, options.unshot, 100 * n, scene.threads, scene.control);
    audit.links = solved.iterations * n;
  }
  if (scene.control.cancelled()) { return interrupted(); }
  run.solution.radiosity.assign(scene.hierarchy.size(), Color{0.0});
  for (std::size_t i = 0; i < n; ++i) { run.solution.radiosity[exchange.node(i)] = solved.radiosity[i]; }
  report(run, solved);
  return std::nullopt;
}

HALFLIGHT_INLINE std::optional<Failure> compare_leaves(Run& run, const UniformOptions& options, const LeafExchange& exchange,
                                                       const LeafMaterials& leaves) {
  if (!options.compare) { return std::nullopt; }
  const DiscreteScene& scene = run.scene;
  Comparison& comparison = run.solution.comparison.emplace();
  if (options.solver == UniformSolver::gauss_seidel) {
    comparison.dense = run.solution.radiosity;
  } else if (exchange.size() <= *options.compare) {
    comparison.dense = dense_radiosity(scene, exchange, leaves, options.residual);
  }
  if (scene.control.cancelled()) { return interrupted(); }
  run.watch.lap("compare");
  return std::nullopt;
}

HALFLIGHT_INLINE std::optional<Failure> solve_by_exchanges(Run& run, const UniformOptions& options) {
  const DiscreteScene& scene = run.scene;
  const LeafExchange exchange{scene};
  const LeafMaterials leaves = leaf_materials(exchange, scene);
  const std::uint64_t n = exchange.size(), matrix = options.solver == UniformSolver::gauss_seidel ? n * n * sizeof(float) : 0;
  std::optional<Failure> failure = check_size(run, options, n, exchange.bytes() + matrix);
  if (!failure) { failure = solve_leaves(run, options, exchange, leaves); }
  if (!failure) { failure = compare_leaves(run, options, exchange, leaves); }
  run.solution.audit.bytes += exchange.bytes();
  return failure;
}

// Replaces exchanges: each leaf gathers over its own rays.
HALFLIGHT_INLINE std::optional<Failure> solve_by_lists(Run& run, const UniformOptions& options) {
  const DiscreteScene& scene = run.scene;
  const std::uint64_t n = exposed_leaves(scene.hierarchy, scene.exposure);
  const std::uint64_t rays = n * options.lists.rays * (sizeof(StoredRay) + sizeof(std::uint32_t));
  if (std::optional<Failure> failure = check_size(run, options, n, rays)) { return failure; }
  DenseSolution solved = gather_by_lists(scene, options.lists, options.residual, 1000);
  if (scene.control.cancelled()) { return interrupted(); }
  run.solution.audit.links = solved.exchanges;
  run.solution.radiosity = std::move(solved.radiosity);
  report(run, solved);
  return stage::compare_matrix(run);
}

// Makes the mesh as after links, except that T-vertices are always eliminated.
HALFLIGHT_INLINE void reconstruct_leaves(Run& run) {
  eliminate_t_vertices(run.scene.surfaces);
  run.solution.mesh = run.picture(run.solution.radiosity, run.options.reconstruction);
  run.watch.lap("reconstruct");
}

HALFLIGHT_INLINE Outcome solve_uniform_in_unit(const Scene& scene, const UniformOptions& options, const Control& control) {
  MemoryBudget budget;
  budget.allowed = options.memory.value_or(budget.allowed);
  Run run{scene, options_of(options), control, budget};
  const auto ended = [](std::optional<Failure>& failure) { return Outcome{std::nullopt, std::move(*failure)}; };
  std::optional<Failure> failure = build_evenly(run, options);
  if (failure) { return ended(failure); }
  failure = options.solver == UniformSolver::gather_lists ? solve_by_lists(run, options) : solve_by_exchanges(run, options);
  if (failure) { return ended(failure); }
  const DiscreteScene& cut = run.scene;
  reconstruct_leaves(run);
  (void)stage::compare_picture(run);
  Audit& audit = run.solution.audit;
  audit.nodes = cut.hierarchy.size();
  audit.leaves = exposed_leaves(cut.hierarchy, cut.exposure);
  audit.bytes += cut.hierarchy.capacity() * sizeof(Node) + cut.bytes();
  return run.finish();
}

}  // namespace detail

HALFLIGHT_INLINE Outcome solve_uniform(const Scene& scene, const UniformOptions& options, const Control& control) {
  return detail::unless_out_of_memory([&] {
    return detail::solve_in_own_unit(
        scene, [&](const Scene& in_unit, const LightUnit&) { return detail::solve_uniform_in_unit(in_unit, options, control); });
  });
}

}  // namespace radiosity
