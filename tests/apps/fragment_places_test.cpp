// SPDX-License-Identifier: MIT
// The place at which a fragment of a picture is lit is one that the eye sees, also where narrow things stand before the surface or in it.
#include "catch.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <sstream>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/scene_file.hpp"
#include "seed.hpp"

namespace {

constexpr std::uint32_t side = 40;  // pixels

// A wall two wide, a lamp beside the eye, and bars across the wall: from .02 behind it to `before` in front of it, .1 to .9 of a pixel
// wide, a few pixels apart, turned by an angle.
std::string wall_with_bars(std::mt19937& random, double before) {
  std::uniform_real_distribution<double> uniform;
  std::ostringstream out;
  out.precision(17);
  out << "material white reflectance 0.8\nmaterial dark reflectance 0.2\nmaterial lamp reflectance 0 emission 10\n"
         "polygon wall material white {\n vertex -1 -1 0\n vertex 1 -1 0\n vertex 1 1 0\n vertex -1 1 0\n}\n"
         "polygon lamp material lamp {\n vertex 1 0 4\n vertex 1 1 4\n vertex 2 1 4\n vertex 2 0 4\n}\n";
  const double angle = 180.0 * uniform(random), pixel = 1.2 / side;
  int number = 0;
  for (double at = -0.9; at < 0.9; at += pixel * (1.0 + 3.0 * uniform(random))) {
    const double half = 0.5 * pixel * (0.1 + 0.8 * uniform(random));
    out << "box bar" << number++ << " from " << at - half << " -1 -0.02 to " << at + half << " 1 " << before
        << " material dark rotate 0 0 1 " << angle << "\n";
  }
  return out.str();
}

// The number of fragments that share a pixel with others, all of which the eye must see where they are lit.
int check_places_are_seen(const std::string& text) {
  const apps::SceneResult parsed = apps::parse_scene(text);
  REQUIRE(parsed.file);
  const radiosity::Scene& scene = parsed.file->scene;
  const radiosity::Outcome outcome = radiosity::solve(scene, {.epsilon = 0.5, .min_area = 0.01, .audit_points = 0});
  REQUIRE(outcome.solution);
  const radiosity::FinalGather light{scene, outcome.solution->mesh, outcome.solution->frame};
  radiosity::Camera camera;
  camera.eye = {0.3, 0.2, 5.0};
  camera.forward = -camera.eye;
  camera.up = {0.0, 1.0, 0.0};
  camera.field_of_view = 2.0 * std::atan(0.6 / 5.0) * 180.0 / std::numbers::pi;
  const radiosity::View view = radiosity::make_view(camera, {side, side});
  const radiosity::Control control;
  const radiosity::PictureBlocks blocks{view.size, 1, control};
  radiosity::SeenSurfaces seen{light, view, blocks};
  REQUIRE(seen.look());
  int shared = 0;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    for (const radiosity::Fragment& f : seen.of(b)) {
      if (!(f.share < 1.0f)) { continue; }
      ++shared;
      const glm::dvec3 direction = f.place.point.position - seen.eye().position;
      const auto met = light.seen16(seen.eye(), std::span(&direction, 1), true)[0];
      CAPTURE(f.x, f.y, f.share, f.place.surface);
      REQUIRE(met);
      CHECK(met->surface == f.place.surface);
      CHECK(glm::length(met->point.position - f.place.point.position) < 1e-9 * glm::length(direction));
    }
  }
  return shared;
}

}  // namespace

TEST_CASE("fragments are lit at places that the eye sees") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  for (const double before : {0.001, 0.01, 0.1}) {
    CAPTURE(before);
    CHECK(check_places_are_seen(wall_with_bars(random, before)) > 100);
  }
}
