// SPDX-License-Identifier: MIT

// Stage: makes a mesh in gathered light and splits it until it shows that light as accurately as requested (mesh_refiner.hpp). The
// solution and its own mesh do not change.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/discontinuity/light_meshing.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/mesh_error.hpp>
#include <radiosity/picture/mesh_refiner.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

// The limit of faces: what memory allows, and at most what other programs open readily. Bytes per face: its share of two BReps (800),
// test points (900), and two meshes (600).
[[nodiscard]] HALFLIGHT_INLINE std::uint64_t most_mesh_faces(const Run& run) {
  constexpr std::uint64_t most = 1'000'000, bytes = 2300;
  const MemoryBudget& budget = run.scene.budget;
  if (!budget.limited()) { return most; }
  const std::uint64_t held = budget.peak({run.scene.hierarchy.size(), run.solution.links.size() + run.solution.ray_links.size()});
  return std::min(most, (budget.allowed - std::min(budget.allowed, held)) / bytes);
}

// The error of the picture caused by the mesh's outlines alone, relative L2.
[[nodiscard]] HALFLIGHT_INLINE double outline_error(const MeshRefiner& refiner, const MeshErrorMeter& meter) {
  const double square = meter.square();
  return square > 0.0 ? std::sqrt(refiner.outlines() / square) : 0.0;
}

// Combines the error of the colours with that at the outlines, which is not random.
[[nodiscard]] HALFLIGHT_INLINE ErrorEstimate with_outlines(const ErrorEstimate& colours, double outlines) {
  const double all = std::hypot(colours.relative_l2, outlines);
  const double slope = all > 0.0 ? colours.relative_l2 / all : 1.0;
  return {all, slope * colours.standard_error, std::hypot(colours.low, outlines), std::hypot(colours.high, outlines)};
}

// Splits until the error is at most refinement.wanted or nothing can be split any more; returns false when cancelled. The error at the
// faces' own test points decides how far to split; the independent error of the meter, which includes what these points have missed,
// decides when to stop.
HALFLIGHT_INLINE bool refine_to_wanted(const Run& run, const MeshErrorMeter& meter, MeshRefiner& refiner, MeshRefinement& refinement,
                                       std::optional<Mesh>& refined) {
  const std::uint64_t most = most_mesh_faces(run);
  if (!refiner.gather()) { return false; }
  double goal = 0.9 * refinement.wanted;
  double last = std::numeric_limits<double>::infinity();  // measured error of the previous round
  int rounds_without_gain = 0;
  for (;;) {
    const bool wants_more = refiner.error() > goal;
    const bool split = wants_more && refiner.split(goal, most) > 0;
    if (split) {
      if (!refiner.gather()) { return false; }
      continue;
    }
    Mesh mesh = refiner.mesh();
    Mesh in_scene = mesh;
    to_scene(in_scene, run.scene.frame);
    const std::optional<ErrorEstimate> colours = meter.measure(in_scene);
    if (!colours) { return true; }
    refinement.outlines_after = outline_error(refiner, meter);
    refinement.after = with_outlines(*colours, refinement.outlines_after);
    refinement.faces_after = mesh.faces.size();
    refined = std::move(mesh);
    refinement.met = refinement.after.relative_l2 <= refinement.wanted;
    // The remaining error is not between the corners, or is in few places that the faces' test points have missed; a finer mesh may hit
    // those.
    rounds_without_gain = refinement.after.relative_l2 > 0.95 * last ? rounds_without_gain + 1 : 0;
    last = refinement.after.relative_l2;
    if (refinement.met || wants_more || rounds_without_gain == 2 || !(refiner.error() > 0.0)) { return true; }
    goal = std::min(0.8 * goal, 0.9 * refiner.error());
  }
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> refine_mesh(detail::Run& run) {
  const Options& options = run.options;
  DiscreteScene& scene = run.scene;
  if (!options.mesh_error || !scene.plan.lit || !scene.plan.reflects || run.stopped()) { return std::nullopt; }
  Mesh shown = run.solution.mesh;
  detail::to_scene(shown, scene.frame);
  const FinalGather light{scene.input, shown, scene.frame};
  constexpr std::uint64_t points = 2000;  // their choice makes the estimate uncertain by a tenth of itself if few shadow edges have errors
  const MeshErrorMeter meter{scene, light, shown, points};
  if (const std::optional<ErrorEstimate> colours = meter.measure(shown)) {
    Meshing meshing = scene.meshing;
    if (scene.light_meshing) {
      meshing = [&](const LeafFace& leaf) { return scene.light_meshing->split_part(leaf); };
    }
    const LeafLight leaves{scene.hierarchy, scene.exposure, run.solution.radiosity, scene.materials, &scene.objects};
    MeshRefiner refiner{light, std::move(run.leaf_faces), leaves, meshing, scene.threads, scene.control};
    const double outlines = detail::outline_error(refiner, meter);
    const ErrorEstimate before = detail::with_outlines(*colours, outlines);
    MeshRefinement refinement{*options.mesh_error, before, before, outlines, outlines, shown.faces.size(), shown.faces.size(), false};
    refinement.met = before.relative_l2 <= refinement.wanted;
    if (!refinement.met && !detail::refine_to_wanted(run, meter, refiner, refinement, run.solution.refined)) {
      run.solution.refined.reset();
    }
    if (refinement.met || run.solution.refined) { run.solution.audit.mesh = refinement; }
  }
  run.watch.lap("mesh");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
