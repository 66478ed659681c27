// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <raycast/objects/box.hpp>
#include <raycast/objects/cone.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "scenes.hpp"

namespace scenes {

// A room of 4 x 4 x 2.8 m with a round lamp in a shade, cut out of a cone, that hangs at a random height: most light is reflected by its
// inside first. Objects: room, shade, lamp.
inline radiosity::Scene shaded_lamp(std::uint64_t seed) {
  radiosity::Random random{seed, 0};
  const double rim = 0.15 + 0.1 * random.uniform(), top = 0.4 * rim, height = 0.15 + 0.1 * random.uniform();
  const double z = 1.5 + 0.3 * random.uniform();
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.6}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.1}, radiosity::Color{1000.0}}};
  raycast::CsgNode shade{{}, "shade", raycast::CsgOperation::subtract, {}, {}};
  shade.parts.push_back({raycast::Cone::make({2, 2, z}, {0, 0, height}, rim, top).object, "outside", {}, {}, {}});
  shade.parts.push_back({raycast::Cone::make({2, 2, z - 0.01}, {0, 0, height}, 0.97 * rim, 0.95 * top).object, "inside", {}, {}, {}});
  scene.objects = {object("room", raycast::BoxObject::make({0, 0, 0}, {4, 4, 2.8}).object, 0, true),
                   object("shade", raycast::Csg::make(shade).object, 0),
                   object("lamp", raycast::Sphere::make({2, 2, z + 0.4 * height}, 0.2 * rim).object, 1)};
  return scene;
}

}  // namespace scenes
