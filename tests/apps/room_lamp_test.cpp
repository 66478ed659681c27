// SPDX-License-Identifier: MIT
// The lamp that a room without light gets.

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/intake/model.hpp"
#include "apps/intake/to_scene.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

namespace {

// A closed room with a beam under its ceiling, one side of which lies in the middle plane of the room, and with boxes on its floor.
apps::Model room_with_beam(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  apps::Model model;
  model.groups = {"room"};
  model.materials = {{"grey", radiosity::Color(0.5)}};
  const glm::dvec3 size = glm::dvec3(3.0 + 4.0 * unit(random), 3.0 + 4.0 * unit(random), 2.5 + unit(random));
  houses::add_box(model, glm::dvec3(0.0), size, true);
  houses::add_box(model, {0.5 * size.x, 0.0, 0.9 * size.z}, {0.5 * size.x + 0.2, size.y, size.z}, false);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 lo = size * glm::dvec3(0.7 * unit(random), 0.7 * unit(random), 0.0);
    houses::add_box(model, lo, lo + size * glm::dvec3(0.1 + 0.15 * unit(random), 0.1 + 0.15 * unit(random), 0.3), false);
  }
  return model;
}

struct Lamp {
  glm::dvec3 middle{0.0};
  double area = 0.0;
};

std::optional<Lamp> room_lamp_of(apps::Model model) {
  std::vector<std::string> faults;
  const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
  if (!file || !models::noted(file->notes, "hangs under its ceiling")) { return std::nullopt; }
  const auto& shape = *file->scene.objects.back().shape;
  return Lamp{shape.bounds().centre(), shape.bounds().half_area()};
}

}  // namespace

TEST_CASE("the lamp of a room without light does not depend on where the room stands and how it is turned") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const apps::Model room = room_with_beam(random);
    raycast::Box bounds;
    for (const glm::dvec3& p : room.positions) { bounds.extend(p); }
    const double size = bounds.diameter();
    const auto expected = room_lamp_of(room);
    REQUIRE(expected);
    for (int variant = 0; variant < 3; ++variant) {
      const double angle = variant == 0 ? 0.0 : 2.0 * std::numbers::pi * unit(random);
      const glm::dvec3 move = 10.0 * (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5);
      const auto moved = [&](const glm::dvec3& p) {
        const double c = std::cos(angle), s = std::sin(angle);
        return glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z) + move;
      };
      apps::Model there = room;
      for (glm::dvec3& p : there.positions) { p = moved(p); }
      const auto lamp = room_lamp_of(std::move(there));
      REQUIRE(lamp);
      CAPTURE(round, variant, angle, expected->area, lamp->area);
      CHECK(std::abs(lamp->area / expected->area - 1.0) < 0.15);
      CHECK(glm::length(lamp->middle - moved(expected->middle)) < 0.15 * size);
    }
  }
}
