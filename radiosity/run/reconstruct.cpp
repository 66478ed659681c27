// SPDX-License-Identifier: MIT

// Stage: computes the colours of the half-edges from the leaves' radiosities (paper 4.5).

#include <optional>

#include <brep/inline.hpp>

#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/solve.hpp>

namespace radiosity {

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> reconstruct(detail::Run& run) {
  DiscreteScene& scene = run.scene;
  const Options& options = run.options;
  if (options.mesh_error) { run.leaf_faces = scene.surfaces; }
  const bool constant = options.reconstruction >= Reconstruction::constant;
  run.t_vertices = (!constant || !scene.plan.shortcuts) && eliminate_t_vertices(scene.surfaces) > 0;
  if (options.error && !scene.control.picture_error && run.f_refined()) {  // one Jacobi step from E: the light that was reflected once
    const ColorSolution once =
        solve_channels(*run.transport, run.transport->area(), surface_light(scene), {Solver::jacobi, options.residual, 1});
    run.direct = run.picture(once.radiosity, options.reconstruction);
  }
  run.solution.mesh = run.picture(run.solution.radiosity, options.reconstruction);
  run.watch.lap("reconstruct");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
