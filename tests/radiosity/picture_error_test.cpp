// SPDX-License-Identifier: MIT

// The audit of a picture: it finds errors that were put into pixels, where they are, and only those that the camera sees.

#include <atomic>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>

#include <radiosity/audit/picture_error.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

using radiosity::Color;
using radiosity::PictureAudit;
using radiosity::PictureError;
using radiosity::ShownPicture;

namespace {

// A camera at `eye` that looks along +y, 90 degrees wide; displayed levels are 100 times the radiosity.
ShownPicture seen_from(const glm::dvec3& eye, std::function<Color(std::uint32_t, std::uint32_t)> radiosity) {
  return {32, 32,
          [eye](double x, double y) {
            return raycast::Segment{eye, {x / 16.0 - 1.0, 1.0, 1.0 - y / 16.0}};
          },
          std::move(radiosity), [](double b) { return 100.0 * b; }};
}

PictureError measured_picture(const radiosity::Scene& scene, const ShownPicture& picture, unsigned threads = 1, std::uint64_t points = 400,
                              std::uint64_t seed = 1) {
  const auto audit = PictureAudit::make(scene);
  REQUIRE(audit);
  const auto error = audit->measure(picture, {points, 400'000}, threads, seed);
  REQUIRE(error);
  return *error;
}

}  // namespace

TEST_CASE("picture audit: a picture of a furnace that is right is found right, one that is off by 5 % as much off everywhere",
          "[accuracy]") {
  const radiosity::Scene scene = scenes::furnace_with_things(0.5);  // B = 1, half of it reflected
  const glm::dvec3 eye{0.5, 0.02, 0.5};
  int found_right = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const PictureError right = measured_picture(scene, seen_from(eye, [](auto, auto) { return Color{1.0}; }), 1, 400, seed);
    CAPTURE(seed, right.error.low, right.error.high);
    CHECK(right.error.high < 0.025);
    CHECK(right.over8.least == 0.0);
    found_right += right.error.low == 0.0 ? 1 : 0;
  }
  CAPTURE(found_right);
  CHECK(found_right >= 36);  // of 40 intervals one in 40 lies above 0: fewer in one of 300 cases
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PictureError off = measured_picture(scene, seen_from(eye, [](auto, auto) { return Color{1.05}; }), 1, 400, seed);
    CAPTURE(seed, off.error.relative_l2, off.error.low, off.error.high);
    held += off.error.low <= 0.1 && off.error.high >= 0.1 ? 1 : 0;
    CHECK(off.error.high - off.error.low < 0.05);
    CHECK(off.audited == 1.0);
    CHECK(off.over2.most == test::Approx(1.0));  // by 5 levels
    CHECK(off.over8.least == 0.0);
  }
  CHECK(held >= 16);  // of 20 intervals of 95 %, fewer in one of 400 cases
}

TEST_CASE("picture audit: an error in one tile is found in that tile") {
  const auto shown = [](std::uint32_t x, std::uint32_t y) { return Color{x / 8 == 2 && y / 8 == 1 ? 1.5 : 1.0}; };
  // At least 2000 pixels are drawn: of a share of a sixteenth the standard error is .0054.
  const PictureError error = measured_picture(scenes::furnace_with_things(0.5), seen_from({0.5, 0.02, 0.5}, shown), 1, 8000);
  REQUIRE(error.worst);
  CHECK(error.worst->column == 2);
  CHECK(error.worst->row == 1);
  CHECK(error.worst->error.low <= 1.0);  // off by .5, where .5 is reflected
  CHECK(error.worst->error.high >= 1.0);
  CHECK(error.over8.least <= 1.0 / 16.0 + 0.02);
  CHECK(error.over8.most >= 1.0 / 16.0);
  CHECK(error.error.low <= 0.25);
  CHECK(error.error.high >= 0.25);
}

TEST_CASE("picture audit: lamps are left out, whatever the picture shows there, so is what meets nothing") {
  // A vertical plate of side 4 in front of the camera, lit by a sphere lamp in front of it, which hides a part of it.
  radiosity::Scene scene{{{"plate", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{400.0}}}, {}};
  scene.objects = {scenes::plate("plate", {{-2, 3, -2}, {2, 3, -2}, {2, 3, 2}, {-2, 3, 2}}, 0),
                   scenes::object("lamp", raycast::Sphere::make({0, 2, 0}, 0.2).object, 1)};
  const auto shown = [](std::uint32_t x, std::uint32_t y) {  // the mean over 8 x 8 points of a pixel
    Color sum{0.0};
    for (int k = 0; k < 64; ++k) {
      const double px = 3.0 * ((x + (k % 8 + 0.5) / 8.0) / 16.0 - 1.0), pz = 3.0 * (1.0 - (y + (k / 8 + 0.5) / 8.0) / 16.0);
      const double d2 = px * px + pz * pz + 1.0;
      if (std::abs(px) < 2.0 && std::abs(pz) < 2.0) { sum += Color{0.5 * 400.0 * 0.04 / (d2 * std::sqrt(d2)) / 64.0}; }
    }
    const double lx = 2.0 * ((x + 0.5) / 16.0 - 1.0), lz = 2.0 * (1.0 - (y + 0.5) / 16.0);
    return lx * lx + lz * lz < 0.09 ? Color{-1000.0} : sum;
  };
  const PictureError error = measured_picture(scene, seen_from({0, 0, 0}, shown));
  CAPTURE(error.error.relative_l2, error.error.low, error.error.high, error.audited);
  CHECK(error.error.high < 0.02);
  CHECK(error.audited > 0.3);  // of the picture 4/9 are the plate
  CHECK(error.audited < 0.5);
}

TEST_CASE("picture audit: specks of lamps that the picture found and the audit would miss do not count") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  int held = 0;
  for (int trial = 0; trial < 10; ++trial) {
    // A plate as in the last test, lit by a lamp out of the picture, with specks of .05 to .25 of a pixel on it, 1e4 to 1e6 times as
    // bright.
    radiosity::Scene scene{{{"plate", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{400.0}}, {"speck", Color{0.0}, Color{0.0}}}, {}};
    scene.materials[2].emission = Color{std::pow(10.0, uniform(4.0, 6.0))};
    scene.objects = {scenes::plate("plate", {{-4, 3, -4}, {4, 3, -4}, {4, 3, 4}, {-4, 3, 4}}, 0),
                     scenes::object("lamp", raycast::Sphere::make({0, 2, 6}, 0.2).object, 1)};
    std::vector<char> of_speck(32 * 32, 0);
    for (int k = 0; k < 40; ++k) {
      const double size = uniform(0.05, 0.25) * 3.0 / 16.0;  // they look at the camera, so their light does not fall on the plate
      const double x = uniform(-2.9, 2.9 - size), z = uniform(-2.9, 2.9 - size), y = 2.999;
      scene.objects.push_back(scenes::plate("speck", {{x, y, z}, {x + size, y, z}, {x + size, y, z + size}, {x, y, z + size}}, 2));
      for (const double u : {x, x + size}) {
        for (const double v : {z, z + size}) {
          const auto column = static_cast<int>(16.0 * (u / y + 1.0)), row = static_cast<int>(16.0 * (1.0 - v / y));
          of_speck[static_cast<std::size_t>(32 * row + column)] = 1;
        }
      }
    }
    ShownPicture picture = seen_from({0, 0, 0}, [&](std::uint32_t x, std::uint32_t y) {  // the mean over 8 x 8 points of a pixel
      Color sum{0.0};
      for (int k = 0; k < 64; ++k) {
        const double px = 3.0 * ((x + (k % 8 + 0.5) / 8.0) / 16.0 - 1.0), pz = 3.0 * (1.0 - (y + (k / 8 + 0.5) / 8.0) / 16.0);
        const double d2 = px * px + 1.0 + (6.0 - pz) * (6.0 - pz);
        sum += Color{0.5 * 400.0 * 0.04 / (d2 * std::sqrt(d2)) / 64.0};
      }
      return sum + (of_speck[32 * y + x] != 0 ? 0.01 * scene.materials[2].emission : Color{0.0});
    });
    picture.partly_lamp = [&](std::uint32_t x, std::uint32_t y) { return of_speck[32 * y + x] != 0; };
    const PictureError error = measured_picture(scene, picture, 1, 400, random());
    CAPTURE(trial, error.error.relative_l2, error.error.low, error.error.high, error.audited);
    held += error.error.low < 0.02 ? 1 : 0;
    CHECK(error.audited > 0.6);
  }
  CHECK(held >= 8);  // of 10 intervals of 95 %, fewer in one of 80 cases
}

TEST_CASE("picture audit: where the camera sees little of the scene, pixels are drawn until enough of them see it") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  // A plate that takes 6 by 6 pixels of 32 by 32; the lamp is out of the picture. Shown a tenth too bright.
  constexpr double s = 9.0 / 16.0;
  radiosity::Scene scene{{{"plate", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{400.0}}}, {}};
  scene.objects = {scenes::plate("plate", {{-s, 3, -s}, {s, 3, -s}, {s, 3, s}, {-s, 3, s}}, 0),
                   scenes::object("lamp", raycast::Sphere::make({0, 2, 4}, 0.2).object, 1)};
  const auto shown = [](std::uint32_t x, std::uint32_t y) {  // the mean over 8 x 8 points of a pixel
    Color sum{0.0};
    for (int k = 0; k < 64; ++k) {
      const double px = 3.0 * ((x + (k % 8 + 0.5) / 8.0) / 16.0 - 1.0), pz = 3.0 * (1.0 - (y + (k / 8 + 0.5) / 8.0) / 16.0);
      const double d2 = px * px + 1.0 + (4.0 - pz) * (4.0 - pz);
      if (std::abs(px) < s && std::abs(pz) < s) { sum += Color{1.1 * 0.5 * 400.0 * 0.04 / (d2 * std::sqrt(d2)) / 64.0}; }
    }
    return sum;
  };
  int held = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const PictureError error = measured_picture(scene, seen_from({0, 0, 0}, shown), 1, 400, random());
    CAPTURE(trial, error.points, error.error.relative_l2, error.error.low, error.error.high);
    CHECK(error.points >= 8);  // a pilot of as many pixels met at least 16
    held += error.error.low <= 0.1 && error.error.high >= 0.1 ? 1 : 0;
  }
  CHECK(held >= 14);  // of 20 intervals of 95 %, fewer in one of 30 000 cases
}

TEST_CASE("picture audit: where all emits, the edge of a lamp before nothing is left out as lamps are") {
  // One sphere of which nothing arrives anywhere: B = E = 1, so no light is reflected and there is nothing to be wrong about.
  radiosity::Scene scene{{{"lamp", Color{0.5}, Color{1.0}}}, {}};
  scene.objects = {scenes::object("lamp", raycast::Sphere::make({0, 2, 0}, 1.0).object, 0)};
  const auto audit = PictureAudit::make(scene);
  REQUIRE(audit);
  const auto shown = [](std::uint32_t x, std::uint32_t y) {  // the cone of half-angle 30 degrees, its mean over 16 x 16 points of a pixel
    Color sum{0.0};
    for (int k = 0; k < 256; ++k) {
      const double px = (x + (k % 16 + 0.5) / 16.0) / 16.0 - 1.0, pz = 1.0 - (y + (k / 16 + 0.5) / 16.0) / 16.0;
      if (px * px + pz * pz < 1.0 / 3.0) { sum += Color{1.0 / 256.0}; }
    }
    return sum;
  };
  CHECK_FALSE(audit->measure(seen_from({0, 0, 0}, shown), {400, 400'000}, 1, 1));
}

TEST_CASE("picture audit: results do not depend on the number of threads") {
  const auto picture = seen_from({0.5, 0.02, 0.5}, [](std::uint32_t x, auto) { return Color{1.0 + 0.01 * x}; });
  const PictureError one = measured_picture(scenes::furnace_with_things(0.3), picture, 1),
                     two = measured_picture(scenes::furnace_with_things(0.3), picture, 2);
  CHECK(one.error.relative_l2 == two.error.relative_l2);
  CHECK(one.error.high == two.error.high);
  CHECK(one.rays == two.rays);
}

TEST_CASE("picture audit: an error that is not measured has a reason, unless the audit was told to stop") {
  const radiosity::Scene closed = scenes::furnace_with_things(0.5);
  radiosity::Scene shining = scenes::two_plates(0.5);
  radiosity::Scene dark = scenes::two_plates(0.5);
  for (radiosity::Material& material : dark.materials) { material.emission = Color{0.0}; }
  const std::atomic<bool> stop{true};
  struct Case {
    const char* name;
    radiosity::Scene scene;
    glm::dvec3 eye;
    bool stopped, measured;
    const char* reason;
  };
  const Case cases[] = {{"a furnace", closed, {0.5, 0.02, 0.5}, false, true, ""},
                        {"a furnace, stopped", closed, {0.5, 0.02, 0.5}, true, false, ""},
                        {"nothing", shining, {0.5, 5.0, 0.5}, false, false, "it shows no surface that does not shine"},
                        {"plates without a lamp",
                         dark,
                         {0.5, -2.0, 0.5},
                         false,
                         false,
                         "hardly any path from its pixels meets light that could be compared with it"}};
  for (const Case& of : cases) {
    INFO(of.name);
    const auto audit = PictureAudit::make(of.scene);
    REQUIRE(audit);
    radiosity::Control control;
    if (of.stopped) { control.cancel = &stop; }
    std::string reason;
    const auto error = audit->measure(seen_from(of.eye, [](auto, auto) { return Color{1.0}; }), {400, 400'000}, 1, 1, control, &reason);
    CHECK(error.has_value() == of.measured);
    CHECK(reason == of.reason);
  }
}
