// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/picture/make_mesh.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/uniform.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>

#include <raycast/inline.hpp>
#include <raycast/scene.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/polygons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/matrix/dense.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/refinement/refine.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/own_unit.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE Outcome solve_uniform_in_unit(const Scene& scene, const UniformOptions& options, const Control& control) {
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

HALFLIGHT_INLINE Outcome solve_uniform(const Scene& scene, const UniformOptions& options, const Control& control) {
  return detail::unless_out_of_memory([&] {
    return detail::solve_in_own_unit(
        scene, [&](const Scene& in_unit, const LightUnit&) { return detail::solve_uniform_in_unit(in_unit, options, control); });
  });
}

}  // namespace radiosity
