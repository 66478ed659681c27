// SPDX-License-Identifier: MIT

// Stages for studies: a solution with all pairs of the same leaves, and the mesh of the other reconstruction.

#include <cstdint>
#include <optional>

#include <brep/inline.hpp>

#include <radiosity/matrix/dense.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>

namespace radiosity {

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> compare_matrix(detail::Run& run) {
  if (!run.options.compare) { return std::nullopt; }
  const DiscreteScene& scene = run.scene;
  Solution& solution = run.solution;
  solution.comparison.emplace();
  const std::uint64_t leaves = exposed_leaves(scene.hierarchy, scene.exposure);
  const std::uint64_t matrix = 8 * leaves * leaves;
  const bool fits = scene.budget.allows({scene.hierarchy.size(), solution.links.size(), 0, matrix / 2});
  if (leaves <= *run.options.compare && fits && !solution.audit.interrupted) {
    const LeafExchange exchange{scene};
    solution.comparison->dense = dense_radiosity(scene, exchange, leaf_materials(exchange, scene), run.options.residual);
  }
  if (scene.control.cancelled()) { return detail::cancelled(); }
  run.watch.lap("compare");
  return std::nullopt;
}

HALFLIGHT_INLINE std::optional<Failure> compare_picture(detail::Run& run) {
  if (!run.solution.comparison) { return std::nullopt; }
  Mesh& mesh = run.solution.comparison->other;
  mesh = run.picture(run.solution.radiosity, other(run.options.reconstruction));
  detail::to_scene(mesh, run.scene.frame);
  run.watch.lap("compare");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
