// SPDX-License-Identifier: MIT
#pragma once

// Finds rooms in models of other programs. Most of these are no closed shells: each wall is an object, and windows and doors are open.

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/scene.hpp>

namespace apps {

class OpenRooms {
 public:
  explicit OpenRooms(const radiosity::Scene& scene);

  // The bounds of what is seen from a point all around; nothing if more than a tenth of the directions meet nothing, because light from
  // outside then reaches the surroundings. Beside a doorway a quarter may, if from the middle of what is seen only a tenth does.
  [[nodiscard]] std::optional<raycast::Box> around(const glm::dvec3& eye) const;

  struct Hidden {
    glm::dvec3 eye{0.0};  // a place in the room
    raycast::Box bounds;
  };
  // A room that nobody sees from outside: from a place in it, at least three times as many surfaces are seen as from any side outside,
  // nearly all of them from the front, but for a roof. A box with furniture is one; a house that has more to show outside is not, nor is a
  // hollow body in which one sees nine tenths skin.
  [[nodiscard]] std::optional<Hidden> hidden() const;

  // The bounds of rooms whose walls are given from inside alone, if most of what the automatic view shows is seen through the backs of
  // surfaces: as in a doll's house, which light from outside does not reach. Nothing if they are open to it.
  [[nodiscard]] std::vector<raycast::Box> seen_through() const;

  using Surfaces = std::set<std::pair<std::uint32_t, std::uint32_t>>;  // object and sheet
  // The open surfaces of a roof over the room around this point, if it shows its back there, as a roof that was given from outside alone.
  [[nodiscard]] Surfaces roof_over(const glm::dvec3& eye) const;

 private:
  // What is seen in many directions: its bounds, and the shares of directions that meet nothing, fronts or the backs of a roof, and the
  // skin of the one object whose skin is met most often.
  struct Around {
    raycast::Box bounds;
    double open = 0.0, shown = 0.0, skin = 0.0;
    Surfaces surfaces, roof;
  };
  [[nodiscard]] Around look_around(const glm::dvec3& eye) const;
  // Is the surface at this point a wall without thickness to the outside: is there nothing behind it, or air up to one more surface, as a
  // ground? Behind a thing in a room there are its other side and the wall.
  [[nodiscard]] bool is_skin(const glm::dvec3& at, const glm::dvec3& direction) const;
  [[nodiscard]] bool is_room(const Around& here) const;  // as around() asks

  const radiosity::Scene& scene_;
  raycast::Scene objects_;
};

}  // namespace apps
