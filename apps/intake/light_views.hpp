// SPDX-License-Identifier: MIT
#pragma once

// Determines how much of a model's light cameras see; finds a camera inside if the automatic one sees almost none of it, as for
// a house with lamps in its rooms; and places lamps in rooms without any.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"

namespace apps {

class LightViews {
 public:
  // If less than this share of what a camera sees is lit directly by a lamp, that is almost nothing.
  static constexpr double tol_dark = 0.02;
  // Seen from outside, a house shows its light only through some windows. If less than `little_light` of what the automatic view sees is
  // lit, a view from inside replaces it, provided that at least `much_light` of what this sees is lit (`tol_dark`, if the automatic view
  // sees less than that).
  static constexpr double little_light = 0.2, much_light = 0.5;

  explicit LightViews(const radiosity::Scene& scene);

  // Of the rays of a coarse picture that meet a surface, the share that meet a lamp or a surface directly lit by one. As in pictures,
  // rays pass through the backs of surfaces.
  [[nodiscard]] double lit_share(const radiosity::Camera& camera) const;

  struct Chosen {
    radiosity::Camera camera;
    double lit = 0.0;  // share of all rays of its picture that meet what is lit
  };
  // A view across the room of one of the brightest lamps, from its far end: the view that sees most light. Where the room is open, it looks
  // away from the opening. Nothing if there is no lamp or no suitable place. Does not depend on the order of the polygons of a lamp.
  [[nodiscard]] std::optional<Chosen> inside() const;

  // The bounds of what is seen from a point all around; nothing if more than a tenth of the directions meet nothing, because light from
  // outside then reaches the surroundings.
  [[nodiscard]] std::optional<raycast::Box> room_around(const glm::dvec3& eye) const;

  // A lamp for a closed room without light: a square close below the ceiling (z up) of the room within these bounds, facing down, where
  // there is most air around and below it. Null if no place was found.
  [[nodiscard]] std::shared_ptr<const raycast::Object> ceiling_lamp(const raycast::Box& room) const;

 private:
  // Of the rays of a picture: the shares that meet a front first, that meet one after some backs, and one that is lit.
  struct Seen {
    double fronts = 0.0, met = 0.0, lit = 0.0;
  };
  static constexpr std::uint32_t fine = 24, coarse = 12;  // rays across

  // `across`: rays from left to right. Without light, `lit` stays 0.
  [[nodiscard]] Seen seen(const radiosity::Camera& camera, std::uint32_t across, bool with_light) const;
  [[nodiscard]] bool lit(const raycast::ScenePoint& at) const;
  // The distance to the first surface; 0 if its back is seen or there is none, because the point is then not in the air of a room.
  [[nodiscard]] double free_way(const glm::dvec3& from, const glm::dvec3& direction) const;
  // The same, horizontally; in a direction in which the room is open, the distance to the opening.
  [[nodiscard]] double way_in_room(const glm::dvec3& from, const glm::dvec3& direction) const;
  [[nodiscard]] std::optional<radiosity::Camera> across_room(glm::dvec3 middle) const;

  raycast::Scene objects_;
  double size_ = 0.0;                        // of what is lit
  std::vector<raycast::ScenePoint> points_;  // on some of the lamps
  std::vector<std::uint32_t> lamps_;         // objects, by decreasing power
};

}  // namespace apps
