// SPDX-License-Identifier: MIT
#pragma once

// A floor under a lamp, and what LitRegion says of points on it.

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"

namespace scenes {

struct World {
  explicit World(radiosity::Scene input) : scene{std::move(input)} {
    auto result = radiosity::prepare(scene);
    REQUIRE(result.prepared);
    prepared = std::make_unique<radiosity::Prepared>(std::move(*result.prepared));
    std::vector<radiosity::Color> emission;
    for (const radiosity::InputSurface& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
    light = radiosity::DirectLight{prepared->objects, prepared->surfaces, emission, {64, 1.0}};
  }
  [[nodiscard]] glm::dvec3 in_frame(const glm::dvec3& x) const { return (x - prepared->frame.centre) * prepared->frame.scale; }
  // A region of object 0, which lies in the plane z = 0: a square of half the side r about x.
  [[nodiscard]] radiosity::LitRegion region(const glm::dvec3& x, double r, radiosity::Shadows shadows = radiosity::Shadows::exact) const {
    const std::array<glm::dvec3, 4> contour{in_frame(x + glm::dvec3{-r, -r, 0}), in_frame(x + glm::dvec3{r, -r, 0}),
                                            in_frame(x + glm::dvec3{r, r, 0}), in_frame(x + glm::dvec3{-r, r, 0})};
    return {light, {contour, 0, 0.0}, {0, 0, 1}, shadows};
  }

  radiosity::Scene scene;
  std::unique_ptr<radiosity::Prepared> prepared;
  radiosity::DirectLight light;
};

// A floor, object 0, under a square lamp of half the side r, object 1, and materials 0 for things and 1 for lamps.
inline radiosity::Scene floor_under_lamp(double r) {
  using radiosity::Color;
  radiosity::Scene scene{{{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}}, {}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::square("lamp", {0, 0, 1.5}, r, false, 1)};
  return scene;
}

}  // namespace scenes
