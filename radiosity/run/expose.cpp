// SPDX-License-Identifier: MIT

// Stage: measures the exposed part of each patch, and finds closed parts if the scene is not proven closed.

#include <optional>
#include <string>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/audit/closed_parts.hpp>
#include <radiosity/audit/warnings.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>

namespace radiosity {

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> expose(detail::Run& run) {
  DiscreteScene& scene = run.scene;
  Audit& audit = run.solution.audit;
  scene.expose();
  if (scene.exposure.all_buried) {
    return Failure{Failure::Kind::invalid_scene,
                   {"every surface is buried under another object: nothing can be seen. Two rooms made by 'inside' "
                    "that do not overlap bury each other, for beyond its walls a room is solid"}};
  }
  for (std::string& sentence : warnings_of_buried(scene.input, scene.hierarchy, scene.exposure)) {
    audit.warnings.push_back(std::move(sentence));
  }
  if (!scene.plan.closed && run.needs_links()) {
    ClosedParts found = find_closed_parts(scene);
    audit.stray = found.stray;
    if (found.lossless) {
      return Failure{Failure::Kind::invalid_scene,
                     {"a part of the scene is closed, as far as rays tell (" + std::to_string(found.stray.closed_lost) + " of " +
                      std::to_string(found.stray.closed_rays) +
                      " were lost), and nothing in it absorbs light in some channel in which it emits: the light would grow without end; "
                      "give some surface a reflectance below 1, or the light a larger way out"}};
    }
    scene.closed = std::move(found.nodes);
  }
  run.watch.lap("expose");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
