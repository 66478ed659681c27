// SPDX-License-Identifier: MIT
#pragma once

// Random rooms for the tests of the intake, and the light in them.

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

namespace rooms {

using soup::Soup;

using RandomRooms = std::mt19937;

inline double number_in(RandomRooms& random, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

// The six sides of a box, each in a group of its own and each cut as finely as it likes, so that their borders meet in T-joints.
inline void add_sides(Soup& out, RandomRooms& random, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, bool mixed) {
  for (std::uint32_t side = 0; side < 6; ++side) {
    const int n = 1 + static_cast<int>(random() % 3);
    Soup box, one;
    soup::add_box(box, lo, hi, n, inwards);
    const std::size_t each = box.count() / 6;
    out.names.push_back("side" + std::to_string(out.names.size()));
    const bool turned = mixed && random() % 2 == 0;
    for (std::size_t f = side * each; f < (side + 1) * each; ++f) {
      std::vector<glm::dvec3> outline = box.outline(f);
      if (turned) { std::reverse(outline.begin(), outline.end()); }
      out.polygon(outline);
    }
  }
}

inline void add_ceiling_lamp(Soup& out, const glm::dvec3& lo, const glm::dvec3& hi, double under) {
  const glm::dvec3 a = lo + 0.3 * (hi - lo), b = lo + 0.6 * (hi - lo);
  const double z = hi.z - under;
  out.polygon({{a.x, a.y, z}, {a.x, b.y, z}, {b.x, b.y, z}, {b.x, a.y, z}}, 1);  // looks down
}

// Mean radiosity of each group of the soup, by its name without a number.
inline std::map<std::string, radiosity::Color> light_of(const Soup& soup, const radiosity::Intake& intake) {
  const radiosity::Options options{.epsilon = 0.05, .audit_points = 0};
  const radiosity::Outcome outcome = radiosity::solve({soup.materials, intake.objects}, options);
  std::map<std::string, radiosity::Color> sum;
  std::map<std::string, double> area;
  REQUIRE(outcome.solution);
  for (const radiosity::SurfaceMean& surface : outcome.solution->audit.surfaces) {
    const std::string group = surface.name.substr(0, surface.name.find('.'));
    sum[group] += surface.area * surface.radiosity;
    area[group] += surface.area;
  }
  for (auto& [group, light] : sum) { light /= area[group]; }
  return sum;
}

inline void check_same_light(const std::map<std::string, radiosity::Color>& a, const std::map<std::string, radiosity::Color>& b) {
  REQUIRE(a.size() == b.size());
  for (const auto& [group, light] : a) {
    INFO(group);
    REQUIRE(b.count(group) == 1);
    CHECK(glm::length(b.at(group) - light) <= 0.005 * glm::length(light));
    CHECK(light.x > 0.0);
  }
}

// A room, a thing in it and a lamp under its ceiling, each a group; within walls of a thickness, or not.
inline Soup furnished_room(RandomRooms& random, bool walls, double under) {
  Soup room;
  const glm::dvec3 hi{number_in(random, 2.0, 6.0), number_in(random, 2.0, 6.0), number_in(random, 2.0, 4.0)};
  room.names = {"room"};
  soup::add_box(room, glm::dvec3(0.0), hi, 1, true);
  if (walls) {
    room.names.push_back("walls");
    soup::add_box(room, glm::dvec3(-0.2), hi + 0.2);
  }
  room.names.push_back("thing");
  soup::add_box(room, 0.1 * hi, glm::dvec3(0.25, 0.3, number_in(random, 0.2, 0.7)) * hi, 1);
  room.names.push_back("lamp");
  add_ceiling_lamp(room, glm::dvec3(0.0), hi, under);
  return room;
}

}  // namespace rooms
