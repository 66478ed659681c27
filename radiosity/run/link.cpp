// SPDX-License-Identifier: MIT

// Stage: form factors and visibility of the links of F-refinement (paper 4.3).

#include <optional>
#include <utility>

#include <raycast/inline.hpp>

#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>

namespace radiosity {

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> link(detail::Run& run) {
  DiscreteScene& scene = run.scene;
  if (run.f_refined()) {
    if (run.clusters.build) { scene.shown = scene.exposed_shown(); }
    run.evaluated = make_links({scene.evaluator, run.refined.occluders, scene.threads, scene.control},
                               std::exchange(run.refined.linked, {}), run.solution.links);
    if (run.evaluated.cancelled) { return detail::cancelled(); }
  }
  run.watch.lap("link");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
