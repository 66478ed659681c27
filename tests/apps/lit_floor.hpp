// SPDX-License-Identifier: MIT
#pragma once

// A floor in the plane z = 0 under lamps of a file, and random numbers for placing these.

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include <glm/vec3.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/scene_file.hpp"
#include "catch.hpp"
#include "seed.hpp"

namespace lit_floor {

// The irradiance of points of the floor.
class Floor {
 public:
  explicit Floor(const apps::SceneFile& file) : outcome_(radiosity::solve(file.scene, options())) {
    REQUIRE(outcome_.solution);
    light_.emplace(file.scene, outcome_.solution->mesh, outcome_.solution->frame);
  }
  [[nodiscard]] double irradiance(const glm::dvec3& at) {
    const radiosity::Frame& frame = outcome_.solution->frame;
    const glm::dvec3 p = (at - frame.centre) * frame.scale, up{0, 0, 1};
    const std::array<glm::dvec3, 4> contour{p, p, p, p};
    radiosity::LitRegion region{light_->direct(), {contour, 0, 0.0}, up};
    return region.irradiance(p, up).x;
  }

 private:
  static radiosity::Options options() { return {.epsilon = 0.5, .min_area = 0.01, .audit_points = 0}; }

  radiosity::Outcome outcome_;
  std::optional<radiosity::FinalGather> light_;
};

struct Dice {
  unsigned seed = test::seed();
  std::mt19937_64 random{seed};
  double between(double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); }
  glm::dvec3 above_floor(double lowest, double highest) {
    return {between(5.0, 15.0), between(-15.0, -5.0), std::exp(between(std::log(lowest), std::log(highest)))};
  }
  glm::dvec3 on_floor() { return {between(0.5, 19.5), between(-19.5, -0.5), 0.0}; }
  glm::dvec3 downwards(double steepest_sine) {
    const double angle = between(0.0, 2.0 * std::numbers::pi), aside = between(0.0, steepest_sine);
    return {aside * std::cos(angle), aside * std::sin(angle), -std::sqrt(1.0 - aside * aside)};
  }
};

}  // namespace lit_floor
