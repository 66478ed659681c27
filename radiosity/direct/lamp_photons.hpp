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

// A place at which a photon landed, on the front of a surface.
struct Landing {
  raycast::SurfacePoint at;
  std::uint32_t object = 0, sheet = 0;
};
// What a ray from a point of this sheet meets first; nothing where that is a back, or nothing.
using MeetFront = std::function<std::optional<Landing>(const raycast::SurfacePoint& from, const glm::dvec3& direction, std::uint32_t object,
                                                       std::uint32_t sheet)>;

struct LampPhoton {
  Landing landed;
  std::uint32_t source = 0;  // the input surface that it comes from
  double power = 0.0;        // in the same unit for all
};

// `surfaces`: the boundaries of all objects, in their order; `emission`: exitance of each input surface. Half of the photons are sent by
// power; half by surface, for a dim lamp may be all that its room has. `price`: of a ray, in microseconds (raycast::Scene::ray_work): where
// rays are dear, as among curved solids cut out of each other, photons are fewer.
[[nodiscard]] std::vector<LampPhoton> lamp_photons(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                   const MeetFront& meet, double price);

// To choose lamps by; none where fewer than two surfaces shine, for then there is nothing to choose.
[[nodiscard]] std::vector<PhotonGrid::Photon> photons_by_lamp(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                              const MeetFront& meet, double price);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/lamp_photons.cpp>
#endif
