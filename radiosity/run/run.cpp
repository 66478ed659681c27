// SPDX-License-Identifier: MIT
#include <radiosity/run/run.hpp>

#include <optional>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/matrix/dense.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/f_refinement.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE Run::Run(const Scene& input, const Options& with, const Control& control, const MemoryBudget& within)
    : options{with}, scene{input, thread_count(with.threads), with.seed, control, within} {
  if (options.meshing) { scene.meshing = options.meshing; }
  solution.links = Links(within.arrays);
  solution.audit.threads = scene.threads;
  solution.audit.seed = options.seed;
}

HALFLIGHT_INLINE std::optional<Failure> Run::prepare_scene() {
  // Each input surface has a node, even if it is covered. If these alone are too many, the run is refused before anything is made.
  MemoryBudget::Counts least;
  for (const SceneObject& object : scene.input.objects) { least.nodes += object.shape ? object.shape->sheet_count() : 0; }
  if (!scene.budget.allows(least)) { return Failure{Failure::Kind::out_of_memory, {too_large(*this, scene.budget.peak(least))}}; }
  PrepareResult preparation = prepare(scene.input, options.shortcuts, options.min_area);
  if (!preparation.prepared) { return Failure{Failure::Kind::invalid_scene, std::move(preparation.faults)}; }
  scene.take(std::move(*preparation.prepared));
  if (options.caster) { scene.objects.ask(options.caster(scene.objects, scene.frame)); }
  solution.frame = scene.frame;
  solution.audit.channels = scene.plan.channels;
  return std::nullopt;
}

HALFLIGHT_INLINE Mesh Run::picture(const std::vector<Color>& radiosity, Reconstruction kind) {
  return reconstruct(scene.surfaces, {scene.hierarchy, scene.exposure, radiosity, scene.materials, &scene.objects}, kind);
}

HALFLIGHT_INLINE Outcome Run::finish() {
  sum_times(solution.audit);
  to_scene(solution.mesh, scene.frame);
  if (solution.refined) { to_scene(*solution.refined, scene.frame); }
  solution.hierarchy = std::move(scene.hierarchy);
  solution.area = scene.exposure.area;
  return {std::move(solution), {}};
}

}  // namespace detail

}  // namespace radiosity
