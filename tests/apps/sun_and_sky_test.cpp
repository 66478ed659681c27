// SPDX-License-Identifier: MIT
// The sky of a file does not hide its suns.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/to_scene.hpp"
#include "apps/scene_file.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "lit_floor.hpp"
#include "models.hpp"
#include "seed.hpp"

using lit_floor::Dice;
using lit_floor::Floor;

namespace {

// A hemisphere of radius 10 over the middle of the file, dim and one-sided, or one side of a pyramid of the same height: a panel.
std::string dome(bool whole, int sides, int rings) {
  std::ostringstream points, faces;
  points.precision(17);
  for (int ring = 0; ring <= rings; ++ring) {
    const double above = 0.5 * std::numbers::pi * ring / rings;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      points << 10.0 * std::cos(above) * std::cos(angle) << ' ' << 10.0 * std::sin(above) << ' ' << 10.0 * std::cos(above) * std::sin(angle)
             << ", ";
      if (ring == rings || (!whole && k > 0)) { continue; }
      const int a = ring * sides + k, b = ring * sides + (k + 1) % sides;
      faces << a << ", " << b << ", " << b + sides << ", -1, ";
      if (ring + 1 < rings) { faces << a << ", " << b + sides << ", " << a + sides << ", -1, "; }
    }
  }
  return "Shape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor 1e-5 1e-5 1e-5 } } geometry IndexedFaceSet "
         "{ "
         "solid FALSE coord Coordinate { point [ " +
         points.str() + " ] } coordIndex [ " + faces.str() + " ] } }";
}

}  // namespace

// However close the sky comes to the ground.
TEST_CASE("a directional light shines through the sky of its file") {
  Dice dice;
  INFO("seed " << dice.seed);
  for (int round = 0; round < 8; ++round) {
    const double half = dice.between(0.5, 7.0);
    const glm::dvec3 d = dice.downwards(0.8);
    const bool whole = round % 2 == 0;
    CAPTURE(round, half, d.x, d.y, whole);
    std::ostringstream text;
    text.precision(17);
    text << "#VRML V2.0 utf8\nDirectionalLight { direction " << d.x << ' ' << d.z << ' ' << -d.y
         << " } Shape { geometry IndexedFaceSet { coord Coordinate { point [ " << -half << " 0 " << -half << ", " << -half << " 0 " << half
         << ", " << half << " 0 " << half << ", " << half << " 0 " << -half << " ] } coordIndex [ 0, 1, 2, 3, -1 ] } } "
         << dome(whole, 8 + 4 * round, 3 + round % 3);
    const apps::SceneFile file = models::scene("a.wrl", text.str());
    REQUIRE(file.suns.size() == 1);
    if (whole) { CHECK(models::noted(file.warnings, "the sky is enlarged")); }
    Floor floor(file);
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 p{dice.between(-half, half), dice.between(-half, half), 0.0};
      CAPTURE(p.x, p.y);
      CHECK(floor.irradiance(p) == test::Approx(100.0 * -d.z).epsilon(0.02));
    }
  }
}

// Also beside a dome, which is moved.
TEST_CASE("a lamp above a floor is no sky, though it hides the sun") {
  const std::string lamp =
      "Transform { translation 0.3 2.5 0.2 children Shape { appearance Appearance { material Material { emissiveColor 1 1 1 } } geometry "
      "Box { "
      "size 0.2 0.2 0.2 } } } ";
  const std::string floor =
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [ -6 0 -6, -6 0 6, 6 0 6, 6 0 -6 ] } coordIndex [ 0, 1, 2, 3, -1 ] } } ";
  for (const std::string& sky : {std::string(), dome(true, 16, 4)}) {
    const apps::SceneFile file = models::scene("a.wrl", "#VRML V2.0 utf8\nDirectionalLight { direction 0.1 -1 0.2 } " + floor + lamp + sky);
    CHECK(models::noted(file.warnings, "the sky is enlarged") == !sky.empty());
    const auto is_lamp = [](const radiosity::SceneObject& object) {
      return std::abs(radiosity::placed_bounds(*object.shape, object.placement).diameter() - 0.2 * std::sqrt(3.0)) < 1e-6;
    };
    CHECK(std::count_if(file.scene.objects.begin(), file.scene.objects.end(), is_lamp) == 1);
  }
}

// Viewers show all of a mesh: a sky that is enlarged beyond the suns would make a dot of the rest.
TEST_CASE("exported meshes have the sky as large as the file, whatever a sun makes of it") {
  Dice dice;
  INFO("seed " << dice.seed);
  for (int round = 0; round < 3; ++round) {
    const glm::dvec3 d = dice.downwards(0.8);
    std::ostringstream text;
    text.precision(17);
    text << "#VRML V2.0 utf8\nDirectionalLight { direction " << d.x << ' ' << d.z << ' ' << -d.y
         << " } Shape { geometry IndexedFaceSet { coord Coordinate { point [ -3 0 -3, -3 0 3, 3 0 3, 3 0 -3 ] } coordIndex "
            "[ 0, 1, 2, 3, -1 ] } } "
         << dome(true, 8, 3 + round);
    const apps::SceneFile file = models::scene("a.wrl", text.str());
    REQUIRE(file.sky.factor > 1.0);
    const radiosity::Outcome outcome = radiosity::solve(file.scene, {.epsilon = 0.5, .min_area = 0.01, .audit_points = 0});
    REQUIRE(outcome.solution);
    const radiosity::Mesh mesh = apps::without_suns(file, outcome.solution->mesh);
    // The corners of the dome lie at its radius, all else within it; each may be moved by 1e-4 of the size of what is lit.
    const auto distance = [](const glm::dvec3& p) { return glm::length(p); };
    double farthest = 0.0;
    for (const apps::ExportVertex& vertex : apps::solution_mesh(file, *outcome.solution, mesh).vertices) {
      farthest = std::max(farthest, distance(vertex.position));
    }
    CHECK(farthest == test::Approx(10.0).epsilon(1e-3));
    const std::vector<glm::dvec3> places = apps::with_sky_of_file(file, mesh).positions;
    CHECK(std::transform_reduce(
              places.begin(), places.end(), 0.0, [](double a, double b) { return std::max(a, b); }, distance) ==
          test::Approx(10.0).epsilon(1e-3));
  }
}

// A room with a window of a random size in one wall, and a camera beyond the spot that the sun throws on the floor. It looks at the wall
// opposite the window, or back at the spot. Without a window, and with the sun behind the house, the room is dark.
TEST_CASE("a room into which the sun shines gets no lamp, whether its camera sees the spot or not") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  for (int round = 0; round < 12; ++round) {
    const bool shut = round % 4 == 2, from_behind = round % 4 == 3, back = round % 3 == 0;
    apps::Model model;
    model.groups = {"walls"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    const double thick = number(0.1, 0.3), x0 = number(0.5, 1.5), x1 = x0 + number(0.8, 2.0), z0 = number(0.6, 1.2), z1 = number(1.6, 2.4);
    const auto add_wall = [&](const glm::dvec3& lo, const glm::dvec3& hi) { houses::add_box(model, lo, hi, false); };
    add_wall({-thick, -thick, -thick}, {4 + thick, 5 + thick, 0});
    add_wall({-thick, -thick, 3}, {4 + thick, 5 + thick, 3 + thick});
    add_wall({-thick, 0, 0}, {0, 5, 3});
    add_wall({4, 0, 0}, {4 + thick, 5, 3});
    add_wall({-thick, 5, 0}, {4 + thick, 5 + thick, 3});
    add_wall({-thick, -thick, 0}, {shut ? 4 + thick : x0, 0, 3});
    if (!shut) {
      add_wall({x1, -thick, 0}, {4 + thick, 0, 3});
      add_wall({x0, -thick, 0}, {x1, 0, z0});
      add_wall({x0, -thick, z1}, {x1, 0, 3});
    }
    apps::ModelLight sun;
    sun.kind = apps::ModelLight::Kind::sun;
    sun.intensity = radiosity::Color(1.0);
    sun.direction = {number(-0.3, 0.3), from_behind ? -1.0 : 1.0, number(-1.5, -1.0)};  // onto the floor before the window
    model.lights.push_back(sun);
    radiosity::Camera camera;
    camera.name = "within";
    camera.eye = {2, 2.9, 1.6};
    camera.forward = {0, back ? -2 : 2, back ? -1.5 : round % 2 == 0 ? 0.5 : 0.0};
    model.cameras.push_back(camera);
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(models::noted(file->notes, "hangs under its ceiling") == (shut || from_behind));
  }
}
