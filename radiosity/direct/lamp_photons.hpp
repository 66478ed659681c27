// SPDX-License-Identifier: MIT
#pragma once

// Photons that lamps send out, to learn which lamps light which places (photon_grid.hpp). They guide alone: no light is taken from them.

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

// The front that a ray from a point of this sheet meets first; nothing where it meets a back, or nothing.
using MeetFront = std::function<std::optional<raycast::SurfacePoint>(const raycast::SurfacePoint& from, const glm::dvec3& direction,
                                                                     std::uint32_t object, std::uint32_t sheet)>;

// `surfaces`: the boundaries of all objects, in their order; `emission`: exitance of each input surface. The source of a photon is the
// input surface that it comes from. Half of them are sent by power; half by surface, for a dim lamp may be all that its room has. None
// where fewer than two surfaces shine: then there is nothing to choose. `price`: of a ray, in microseconds (raycast::Scene::ray_work):
// where rays are dear, as among curved solids cut out of each other, photons are fewer.
[[nodiscard]] std::vector<PhotonGrid::Photon> lamp_photons(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                           const MeetFront& meet, double price);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/lamp_photons.cpp>
#endif
