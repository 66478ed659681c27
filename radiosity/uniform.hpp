// SPDX-License-Identifier: MIT
#pragma once

// Radiosity as it was before the hierarchy: every input face is cut evenly, whatever the light does, and every leaf exchanges light
// with every other, by a full matrix (Goral et al. 1984, here with Gauss-Seidel) or by shooting (Cohen et al. 1988). The
// path to the solution is that of radiosity.hpp with other refinement and other solvers; the result has the same form.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/radiosity.hpp>
#include <radiosity/wall_cuts.hpp>

namespace radiosity {

enum class UniformSolver { gauss_seidel, progressive };

struct UniformOptions {
  UniformSolver solver = UniformSolver::gauss_seidel;
  double max_area = 1e-3;            // largest leaf, relative to the total area of the scene
  double residual = 1e-8;            // of Gauss-Seidel, relative to the emission
  double unshot = 1e-2;              // of shooting: power at which it ends, relative to the emitted power
  std::uint32_t max_leaves = 20000;  // more are refused: the matrix takes 4 bytes a pair
  Reconstruction reconstruction = Reconstruction::weighted;
  std::optional<std::uint32_t> compare;  // as in Options
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> memory;  // as in Options
};

namespace detail {

[[nodiscard]] inline Outcome solve_uniform_in_unit(const Scene& scene, const UniformOptions& options, const Control& control) {
  Solution solution;
  Audit& audit = solution.audit;
  detail::Stopwatch watch{audit.stages};
  const unsigned threads = thread_count(options.threads);
  audit.threads = threads;
  audit.seed = options.seed;
  if (!(options.max_area > 0.0)) { return failed(Failure::Kind::invalid_options, {"max_area must be above 0"}); }

  PrepareResult preparation = prepare(scene);
  if (!preparation.prepared) { return failed(Failure::Kind::invalid_scene, std::move(preparation.faults)); }
  const raycast::Scene& objects = preparation.prepared->objects;
  std::vector<Surface>& boundary = preparation.prepared->surfaces;
  const Plan& plan = preparation.prepared->plan;
  if (plan.lossless) { return failed(Failure::Kind::invalid_scene, {"closed, and nothing in it absorbs light: there is no solution"}); }
  solution.frame = preparation.prepared->frame;
  audit.channels = plan.channels;
  audit.left_out = plan.left_out;
  Hierarchy& hierarchy = solution.hierarchy;
  cut_at_walls(boundary, objects.diameter());
  hierarchy = make_roots(boundary);
  watch.lap("build");

  const double total = root_area(hierarchy);
  if (hierarchy.size() > options.max_leaves || 1.0 / options.max_area > options.max_leaves) {
    return failed(Failure::Kind::invalid_options,
                  {"more than " + std::to_string(options.max_leaves) + " leaves; a larger max_area needs fewer"});
  }
  split_evenly(boundary, hierarchy, options.max_area * total);
  watch.lap("refine");

  std::vector<std::uint32_t> materials;
  std::vector<Color> reflectance;
  std::vector<Color> emission;
  for (const InputSurface& input : surfaces(scene)) {
    const Material& material = scene.materials[input.material];
    materials.push_back(input.material);
    reflectance.push_back(material.reflectance);
    emission.push_back(material.emission);
  }
  Patches patches{boundary, hierarchy};
  patches.extend(threads);
  Exposure exposure;
  extend(exposure, objects, boundary, hierarchy, patches, threads, options.seed);
  watch.lap("expose");

  const ShownAreas shown;  // there are no clusters
  const LinkEvaluator evaluator{objects, plan, hierarchy, patches, exposure, shown, options.seed};
  const LeafExchange exchange{objects, plan, boundary, hierarchy, patches, exposure, evaluator};
  const LeafMaterials leaves = leaf_materials(exchange, hierarchy, reflectance, emission);
  const std::uint64_t n = exchange.size();
  if (n > options.max_leaves) {
    return failed(Failure::Kind::invalid_options, {std::to_string(n) + " leaves; a larger max_area needs fewer"});
  }
  MemoryBudget budget;
  budget.allowed = options.memory.value_or(budget.allowed);
  budget.fixed = objects.bytes() + exchange.bytes() + (options.solver == UniformSolver::gauss_seidel ? n * n * sizeof(float) : 0);
  if (!budget.allows({hierarchy.size()})) {
    return failed(Failure::Kind::out_of_memory,
                  {too_much_memory(budget.peak({hierarchy.size()}), budget.allowed, "a larger max_area needs less")});
  }
  DenseSolution solved;
  if (options.solver == UniformSolver::gauss_seidel) {
    DenseMatrix matrix = make_matrix(exchange, threads, control);
    watch.lap("link");
    if (plan.closed) {
      audit.closure_limit = explained_closure(matrix, exchange);
      audit.closure = close_rows(matrix, exchange, audit.closure_limit);
    }
    solved = gauss_seidel(matrix, exchange, leaves, options.residual, 1000, control);
    solved.rays = matrix.rays;
    audit.links = n * n;
    audit.bytes = matrix.entry.capacity() * sizeof(float);
  } else {
    solved = shoot(exchange, leaves, options.unshot, 100 * n, threads, control);
    audit.links = solved.iterations * n;
  }
  if (control.cancelled()) { return failed(Failure::Kind::cancelled, {"the run was interrupted"}); }
  audit.iterations = static_cast<std::uint32_t>(solved.iterations);
  audit.residual = solved.residual;
  audit.converged = solved.converged;
  audit.rays = solved.rays.cast;
  audit.rays_avoided = solved.rays.avoided;
  solution.radiosity.assign(hierarchy.size(), Color{0.0});
  for (std::size_t i = 0; i < n; ++i) { solution.radiosity[exchange.node(i)] = solved.radiosity[i]; }
  watch.lap("solve");
  if (options.compare) {
    solution.comparison.emplace();
    if (options.solver == UniformSolver::gauss_seidel) {
      solution.comparison->dense = solution.radiosity;
    } else if (n <= *options.compare) {
      solution.comparison->dense = dense_radiosity(exchange, leaves, plan.closed, hierarchy.size(), options.residual, threads, control);
    }
    if (control.cancelled()) { return failed(Failure::Kind::cancelled, {"the run was interrupted"}); }
    watch.lap("compare");
  }

  eliminate_t_vertices(boundary);
  const auto picture = [&](Reconstruction kind) {
    reconstruct(boundary, hierarchy, exposure, solution.radiosity, materials, kind);
    Mesh mesh = make_mesh(boundary, hierarchy, exposure, solution.radiosity);
    for (glm::dvec3& p : mesh.positions) { p = solution.frame.to_scene(p); }
    return mesh;
  };
  solution.mesh = picture(options.reconstruction);
  watch.lap("reconstruct");
  if (solution.comparison) {
    solution.comparison->other = picture(other(options.reconstruction));
    watch.lap("compare");
  }
  audit.nodes = hierarchy.size();
  audit.leaves = n;
  audit.bytes += hierarchy.capacity() * sizeof(Node) + exchange.bytes() + objects.bytes();
  for (const Surface& surface : boundary) { audit.bytes += surface.brep.bytes(); }
  solution.area = exposure.area;
  detail::sum_times(audit);
  return {std::move(solution), {}};
}

}  // namespace detail

// `links` of the audit counts the entries of the matrix, or the exchanges that were made and not kept. There is no error estimate.
[[nodiscard]] inline Outcome solve_uniform(const Scene& scene, const UniformOptions& options, const Control& control = {}) {
  return detail::unless_out_of_memory([&] {
    return detail::solve_in_own_unit(
        scene, [&](const Scene& in_unit, const LightUnit&) { return detail::solve_uniform_in_unit(in_unit, options, control); });
  });
}

}  // namespace radiosity
