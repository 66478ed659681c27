// SPDX-License-Identifier: MIT
// Spots: the cup around a lamp sends what the file says, whichever way its light fades from the axis.
#include <cmath>
#include <numbers>
#include <random>

#include "apps/intake/model.hpp"
#include "apps/intake/spot_cup.hpp"
#include "catch.hpp"
#include "seed.hpp"

namespace {

using Fade = apps::ModelLight::Fade;

apps::ModelLight spot(Fade fade, double inner, double outer, double power = 0.0) {
  apps::ModelLight light;
  light.kind = apps::ModelLight::Kind::spot;
  light.fade = fade;
  light.inner = inner;
  light.outer = outer;
  light.power = power;
  return light;
}

// Of an intensity, over all directions.
template <class Intensity>
double flux(const Intensity& intensity) {
  constexpr int steps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double angle = (i + 0.5) / steps * 0.5 * std::numbers::pi;
    sum += std::sin(angle) * intensity(angle);
  }
  return sum * 0.5 * std::numbers::pi / steps;
}

}  // namespace

TEST_CASE("spots: the intensity is full on the axis, falls with the angle, and ends with the cone, and its flux is that of the formula") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<> uniform;
  for (int k = 0; k < 50; ++k) {
    const double outer = 0.05 + 1.5 * uniform(random), inner = outer * uniform(random), power = 100.0 * uniform(random);
    for (const Fade fade : {Fade::squared_cosine, Fade::by_angle, Fade::power_of_cosine}) {
      const apps::ModelLight light = spot(fade, inner, outer, power);
      CAPTURE(static_cast<int>(fade), inner, outer, power);
      CHECK(apps::spot_intensity(light, 0.0) == 1.0);
      CHECK(apps::spot_intensity(light, outer) == 0.0);
      double before = 1.0;
      for (int i = 0; i <= 100; ++i) {
        const double now = apps::spot_intensity(light, outer * i / 100.0);
        CHECK(now <= before);
        before = now;
      }
      const double a = std::cos(inner), b = std::cos(outer);
      const double expected = fade == Fade::squared_cosine ? 1.0 - a + (a - b) / 3.0
                              : fade == Fade::by_angle     ? 1.0 - (std::sin(outer) - std::sin(inner)) / (outer - inner)
                                                           : (1.0 - std::pow(b, power + 1.0)) / (power + 1.0);
      CHECK(flux([&](double angle) { return apps::spot_intensity(light, angle); }) ==
            test::Approx(expected).epsilon(4e-3));  // steps of 8e-5 where it ends
    }
  }
}

TEST_CASE("spots: of a cup of any size as much of the ball is seen as rays pass its opening") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<> uniform;
  for (int k = 0; k < 30; ++k) {
    const apps::SpotCup cup{1.05 + 2.0 * uniform(random), 0.1 + 3.0 * uniform(random), 0.0};
    const double angle = 1.5 * uniform(random);
    constexpr int rays = 200;
    int passed = 0, all = 0;
    for (int i = 0; i < rays; ++i) {  // over the disk as which the ball is seen
      for (int j = 0; j < rays; ++j) {
        const double x = (2.0 * i + 1.0) / rays - 1.0, y = (2.0 * j + 1.0) / rays - 1.0;
        if (x * x + y * y > 1.0) { continue; }
        ++all;
        // The ray leaves x cos, -x sin along the axis, and reaches the plane of the opening.
        const double at = x * std::cos(angle) + (cup.depth + x * std::sin(angle)) * std::tan(angle);
        passed += at * at + y * y <= cup.rim * cup.rim ? 1 : 0;
      }
    }
    CAPTURE(cup.rim, cup.depth, angle);
    CHECK(apps::seen_through(cup, angle) ==
          test::Approx(static_cast<double>(passed) / all).margin(0.03));  // by 32 chords, of which few pass where the opening is narrow
  }
}

TEST_CASE("spots: a cup sends as much light as the file says, and from inner to outer cones of any width nearly as it says") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<> uniform;
  for (int k = 0; k < 25; ++k) {
    const double outer = 0.03 + 1.5 * uniform(random), inner = outer * uniform(random), power = std::pow(128.0, uniform(random));
    for (const Fade fade : {Fade::squared_cosine, Fade::by_angle, Fade::power_of_cosine}) {
      const apps::ModelLight light = spot(fade, inner, outer, power);
      const apps::SpotCup cup = apps::spot_cup(light);
      const auto seen = [&](double angle) { return apps::seen_through(cup, angle); };
      const auto wanted = [&](double angle) { return apps::spot_intensity(light, angle); };
      CAPTURE(static_cast<int>(fade), inner, outer, power, cup.rim, cup.depth, cup.difference);
      CHECK(flux(seen) == test::Approx(flux(wanted)).epsilon(0.01));
      const double squares = flux([&](double angle) { return std::pow(seen(angle) - wanted(angle), 2.0); });
      const double of_all = flux([&](double angle) { return std::pow(wanted(angle), 2.0); });
      CHECK(cup.difference == test::Approx(std::sqrt(squares / of_all)).epsilon(0.2).margin(0.01));
      if (fade == Fade::squared_cosine) { CHECK(cup.difference < (inner < 0.9 * outer ? 0.06 : 0.1)); }  // measured: .054; no edge is sharp
      CHECK(seen(0.0) == 1.0);
      CHECK(seen(outer + 0.021) < 1e-3);
      CHECK(cup.rim > 1.0);
      CHECK(cup.depth > 0.0);
    }
  }
}
