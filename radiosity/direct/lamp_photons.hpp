// SPDX-License-Identifier: MIT
#pragma once

// Photons emitted by the lamps, to learn which lamps light which places (photon_grid.hpp). They only guide sampling and carry no light
// into the result.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// The point where a ray from a surface first hits another; nothing if that shows its back there or the ray leaves the scene.
using MeetFront = std::function<std::optional<raycast::ScenePoint>(const raycast::ScenePoint& from, const glm::dvec3& direction)>;

struct LampPhoton {
  raycast::ScenePoint landed;
  std::uint32_t source = 0;  // the emitting input surface
  double power = 0.0;        // in a unit common to all photons
};

// `surfaces`: the boundaries of all objects, in their order; `emission`: exitance of each input surface. Half of the photons are
// distributed by power, half equally among the surfaces, because a dim lamp may be the only one of its room. `price`: of a ray, in
// microseconds (raycast::Scene::ray_work); if rays are expensive, as among curved solids cut out of each other, there are fewer photons.
[[nodiscard]] std::vector<LampPhoton> lamp_photons(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                   const MeetFront& meet, double price);

// Photons for choosing lamps; none if fewer than two surfaces emit.
[[nodiscard]] std::vector<PhotonGrid::Photon> photons_by_lamp(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                              const MeetFront& meet, double price);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/lamp_photons.cpp>
#endif
