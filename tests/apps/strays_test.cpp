// SPDX-License-Identifier: MIT
// Models with some forgotten parts far away from all others.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <glm/geometric.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/bounds.hpp>

#include "catch.hpp"
#include "models.hpp"

using models::noted;
using models::scene;

namespace {

// A box as a group of its own.
std::string box(const glm::dvec3& lo, const glm::dvec3& hi, int number) {
  std::string text = "g box" + std::to_string(number) + "\n";
  for (int k = 0; k < 8; ++k) {
    text += "v " + std::to_string((k & 1) != 0 ? hi.x : lo.x) + " " + std::to_string((k & 2) != 0 ? hi.y : lo.y) + " " +
            std::to_string((k & 4) != 0 ? hi.z : lo.z) + "\n";
  }
  return text + "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n";
}

}  // namespace

TEST_CASE("a model is looked at and lit as it is without its forgotten parts far away") {
  const unsigned seed = 20261131;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto place = [&] { return glm::dvec3{between(-1, 1), between(-1, 1), between(-1, 1)}; };
  for (int round = 0; round < 30; ++round) {
    INFO("round " << round);
    const int things = 20 + round, strays = 1 + round % std::max(1, things / 10);
    std::string model, far;
    for (int i = 0; i < things; ++i) {
      const glm::dvec3 lo = 5.0 * place();
      model += box(lo, lo + glm::dvec3{between(0.2, 2), between(0.2, 2), between(0.2, 2)}, i);
    }
    for (int i = 0; i < strays; ++i) {
      const glm::dvec3 lo = between(300, 3000) * glm::normalize(place() + glm::dvec3(0.1));
      far += box(lo, lo + between(0.1, 100) * glm::dvec3(1.0), things + i);
    }
    const apps::SceneFile alone = scene("a.obj", model), with = scene("a.obj", round % 2 == 0 ? model + far : far + model);
    REQUIRE((alone.cameras.size() == 1 && with.cameras.size() == 1));
    const double size = radiosity::scene_bounds(alone.scene).diameter();
    CHECK(glm::distance(with.cameras[0].eye, alone.cameras[0].eye) < 1e-3 * size);
    const raycast::Box studio = alone.scene.objects[0].shape->bounds(), its = with.scene.objects[0].shape->bounds();
    CHECK(glm::distance(its.lo, studio.lo) + glm::distance(its.hi, studio.hi) < 1e-3 * size);
    CHECK(noted(with.notes, "outside of the studio"));
    CHECK_FALSE(noted(alone.notes, "outside of the studio"));
  }
}

TEST_CASE("a row of things ever farther apart, and few things, have no forgotten parts") {
  for (const int things : {2, 9, 40}) {
    std::string model;
    for (int i = 0; i < things; ++i) {
      const double x = things < 10 && i == things - 1 ? 1000.0 : std::exp(0.2 * i);
      model += box({x, 0, 0}, {x + 0.5, 1, 1}, i);
    }
    const apps::SceneFile file = scene("a.obj", model);
    CHECK_FALSE(noted(file.notes, "outside of the studio"));
    CHECK(radiosity::bounds_without_strays(file.scene).diameter() == radiosity::scene_bounds(file.scene).diameter());
  }
}

// A shell that shines, seen from what it contains, looks the same at any size.
TEST_CASE("a solid around all else is a sky seen from within, and brought near where it is far larger, or left out if it does not shine") {
  const auto file_of = [](double size, const std::string& shape, const std::string& looks, const std::string& more = "") {
    return scene("a.wrl",
                 "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { diffuseColor .5 .5 .5 } } geometry Box { "
                 "size 2 1 2 } }\nTransform { scale " +
                     std::to_string(size) + " " + std::to_string(size) + " " + std::to_string(size) +
                     " children Shape { appearance Appearance { material Material { " + looks + " } } geometry " + shape + " } }" + more);
  };
  const std::string sky = "emissiveColor 1 1 1 diffuseColor 0 0 0", stone = "diffuseColor .5 .5 .5";
  for (const std::string shape : {"Box { }", "Sphere { }", "Cylinder { }"}) {
    for (const double size : {5.0, 10.0, 300.0, 5e3, 8e4}) {
      CAPTURE(shape, size);
      const apps::SceneFile file = file_of(size, shape, sky);
      CHECK(noted(file.notes, "seen from within"));
      CHECK(noted(file.notes, "brought near") == (size > 4e3));
      CHECK(radiosity::scene_bounds(file.scene).diameter() < 4e3);
      const radiosity::Outcome outcome = radiosity::solve(file.scene, {.audit_points = 0, .threads = 1});
      REQUIRE(outcome.solution);
      std::size_t lit = 0;
      for (const radiosity::SurfaceMean& surface : outcome.solution->audit.surfaces) {
        lit += surface.radiosity.x == Approx(0.5 * std::numbers::pi).epsilon(0.01) ? 1 : 0;
      }
      CHECK(lit == 6);
      CHECK(noted(file_of(size, shape, stone).notes, "left out, for it is too far away") == (size > 9.0));
    }
    CHECK_FALSE(noted(file_of(1e6, shape, stone).notes, "encloses"));  // a stone with a speck in it
    // Not where a camera, a light or a thing is outside.
    CHECK_FALSE(noted(file_of(10.0, shape, sky, "\nViewpoint { position 0 0 100 }").notes, "encloses"));
    CHECK_FALSE(noted(file_of(10.0, shape, sky, "\nPointLight { location 0 0 100 }").notes, "encloses"));
    CHECK_FALSE(
        noted(file_of(10.0, shape, sky, "\nTransform { translation 0 9.9 0 children Shape { geometry Sphere { } } }").notes, "encloses"));
  }
}

TEST_CASE("a solid around nothing but a pane, or what has no area, remains") {
  const std::string ball = "#VRML V2.0 utf8\nShape { geometry Sphere { radius 100 } }\nShape { ";
  for (const std::string rest : {"appearance Appearance { material Material { transparency .9 } } geometry Box { } }",
                                 "geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 1 1, 2 2 2 ] } coordIndex [ 0 1 2 ] } }"}) {
    CAPTURE(rest);
    const apps::SceneFile file = scene("a.wrl", ball + rest);
    CHECK_FALSE(noted(file.notes, "encloses"));
    CHECK(radiosity::scene_bounds(file.scene).diameter() > 100.0);
  }
}

TEST_CASE("a far larger sky that the file itself shows from within is brought near, too") {
  const apps::SceneFile sky = scene("a.mgf", "v o =\n p 0 0 0\nm sky =\n ed 100\nsph o -1e4\nm ball =\n rd .5\nsph o 1\n");
  CHECK(noted(sky.notes, "brought near"));
  CHECK_FALSE(noted(sky.notes, "seen from within"));
  CHECK(radiosity::scene_bounds(sky.scene).diameter() < 1e3);
}
