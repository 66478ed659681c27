// SPDX-License-Identifier: MIT

// Stage: what of each patch is not buried, and what a scene that is not closed loses.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <raycast/inline.hpp>

#include <radiosity/audit/warnings.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>

namespace radiosity {

namespace detail {

// Their fractions are known to 1 %.
inline constexpr std::uint32_t stray_ray_count = 2500;

// When four of these are lost at most, less than 5e-4 of the light is (95 % bound of a Poisson count): no more than what quadrature and
// sampling have wrong in the row sums, so that to take these for 1 is the better guess. Things that cross each other or a wall keep most
// rooms of other programs from being proven closed; in white ones the row sums were then most of the error. One ray may be lost between
// two triangles that share an edge.
inline constexpr std::uint32_t closing_ray_count = 20'000, most_lost = 4;

}  // namespace detail

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
    audit.stray = stray_rays(scene, detail::stray_ray_count);
    const auto few_are_lost = [&] { return audit.stray->lost() <= detail::most_lost; };
    if (few_are_lost()) { audit.stray = stray_rays(scene, detail::closing_ray_count); }
    scene.plan.loses_nothing = few_are_lost();
  }
  run.watch.lap("expose");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
