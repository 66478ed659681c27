// SPDX-License-Identifier: MIT
#pragma once

// Models of houses of boxes, as other programs make them.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/intake/model.hpp"

namespace houses {

// A box that looks inwards, as a room does, or outwards. Group 1 is of material 1, others of material 0.
inline void add_box(apps::Model& model, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, std::uint32_t group = 0) {
  constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (int i = 0; i < 8; ++i) {
    model.positions.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
  }
  for (const auto& side : sides) {
    std::vector<std::uint32_t> corners;
    for (const int c : side) { corners.push_back(first + static_cast<std::uint32_t>(c)); }
    if (inwards) { std::reverse(corners.begin(), corners.end()); }
    model.polygon(corners, group == 1 ? 1 : 0, group);
  }
}

// Thick walls, floor and perhaps a ceiling around a room from the origin, each a box of its own; a doorway as wide as `door` in the wall
// y = 0.
inline void add_walls_with_doorway(apps::Model& model, const glm::dvec3& room, double door, double scale, bool ceiling = true) {
  const double thick = 0.2;
  const glm::dvec3 out = room + glm::dvec3(thick);
  const auto wall = [&](const glm::dvec3& lo, const glm::dvec3& hi) { add_box(model, scale * lo, scale * hi, false); };
  wall({-thick, -thick, -thick}, {out.x, out.y, 0});
  if (ceiling) { wall({-thick, -thick, room.z}, out); }
  wall({-thick, -thick, 0}, {0, out.y, room.z});
  wall({room.x, -thick, 0}, {out.x, out.y, room.z});
  wall({0, room.y, 0}, {room.x, out.y, room.z});
  wall({door, -thick, 0}, {room.x, 0, room.z});
}

// As small a house as has what matters: a room with a thing in it, no lamp; walls of a thickness around it, or not.
inline apps::Model house_without_lamp(bool walls) {
  apps::Model model;
  model.groups = {"house"};
  model.materials = {{"grey", radiosity::Color(0.5)}};
  add_box(model, {0, 0, 0}, {4, 4, 3}, true);
  add_box(model, {2, 2, 0.1}, {3, 3, 1}, false);
  if (walls) { add_box(model, {-0.2, -0.2, -0.2}, {4.2, 4.2, 3.2}, false); }
  return model;
}

}  // namespace houses
