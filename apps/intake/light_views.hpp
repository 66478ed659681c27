// SPDX-License-Identifier: MIT
#pragma once

// What cameras see of a model's light, and a camera where the automatic one sees next to none of it: a house with lamps in
// its rooms; and lamps for rooms that have none.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"

namespace apps {

class LightViews {
 public:
  // Less than this share of what a camera sees, lit by no lamp directly, is next to nothing.
  static constexpr double tol_dark = 0.02;
  // From outside a house shows its light through some windows. Where less than `little_light` of what the automatic view sees is lit, a
  // view from within takes its place, if `much_light` of that is.
  static constexpr double little_light = 0.2, much_light = 0.5;

  explicit LightViews(const radiosity::Scene& scene);

  // Of the rays of a coarse picture that meet a surface, the share that meet a lamp or what a lamp shines on directly. As in pictures, rays
  // go on past the backs of surfaces.
  [[nodiscard]] double lit_share(const radiosity::Camera& camera) const;

  // From the far end of the room of one of the brightest lamps, across it: of these views the one that sees most of the light. Nothing when
  // there is no lamp, or no place. Does not depend on the order of the polygons of a lamp.
  [[nodiscard]] std::optional<radiosity::Camera> inside() const;

  // A lamp for a closed room in which nothing shines: a square close under the ceiling (z up) of the room within these bounds. It looks
  // down, where most of the air is around and below it. Null when no place was found.
  [[nodiscard]] std::shared_ptr<const raycast::Object> ceiling_lamp(const raycast::Box& room) const;

 private:
  struct LampPoint {
    std::uint32_t object = 0, sheet = 0;
    raycast::SurfacePoint at;
  };

  [[nodiscard]] bool lit(std::uint32_t object, const raycast::SurfacePoint& at) const;
  // How far it is to the first surface; 0 when that shows its back, or there is none: the point is not in the air of a room.
  [[nodiscard]] double free_way(const glm::dvec3& from, const glm::dvec3& direction) const;
  [[nodiscard]] std::optional<radiosity::Camera> across_room(glm::dvec3 middle) const;

  raycast::Scene objects_;
  std::vector<LampPoint> points_;     // of some of the lamps
  std::vector<std::uint32_t> lamps_;  // objects, those of the largest power first
};

}  // namespace apps
