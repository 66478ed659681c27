// SPDX-License-Identifier: MIT
#pragma once

// The visible share of the picture, for errors weighted by a picture instead of by area.

#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// The share of the picture that a unit of area at this place takes; 0 if it is hidden. Without a viewpoint all places have share 1.
[[nodiscard]] inline double seen_share(const std::optional<Viewpoint>& from, const FinalGather& light, const FinalGather::Place& place) {
  if (!from) { return 1.0; }
  const Frame& frame = light.frame();
  const glm::dvec3 position = frame.to_scene(place.point.position);
  const double share = from->share(position, place.point.normal);
  if (!(share > 0.0)) { return 0.0; }
  const FinalGather::Eye eye{(from->eye - frame.centre) * frame.scale, false};
  const glm::dvec3 direction = place.point.position - eye.position;
  const auto seen = light.seen16(eye, std::span(&direction, 1), false)[0];
  constexpr double near = 1e-3;  // relative to the distance: meshes may stand in for slow objects
  const bool same =
      seen && seen->surface == place.surface && glm::length(seen->point.position - place.point.position) <= near * glm::length(direction);
  return same ? share : 0.0;
}

}  // namespace radiosity
