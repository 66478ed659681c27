// SPDX-License-Identifier: MIT
// Materials of other programs: mirrors, what shines, and what it is called.

#include <numbers>
#include <string>

#include <radiosity/scene/material.hpp>

#include "apps/intake/materials.hpp"
#include "models.hpp"

using models::noted;
using models::read;
using models::scene;

namespace {

radiosity::Material wall_of(const std::string& library, bool told) {
  const apps::SceneFile file = scene("room.obj", models::room_obj, {{"room.mtl", "newmtl wall\n" + library}});
  CHECK(noted(file.notes, "taken as paint of the colour of the mirror") == told);
  return file.scene.materials.at(0);
}

}  // namespace

TEST_CASE("what reflects as a mirror alone is paint of its colour, what is black with usual highlights stays black") {
  CHECK(wall_of("Kd 0 0 0\nKs 0.8 0.6 0.7\n", true).reflectance == radiosity::Color(0.8, 0.6, 0.7));
  CHECK(wall_of("Ks 2 1 0\nKd 0 0 0\n", true).reflectance.x == Approx(0.95).epsilon(1e-12));
  CHECK(wall_of("Kd 0 0 0\nKs 0.5 0.5 0.5\n", false).reflectance == radiosity::Color(0.0));
  CHECK(wall_of("Kd 0.1 0 0\nKs 0.8 0.8 0.8\n", false).reflectance == radiosity::Color(0.1, 0.0, 0.0));
  const auto of_wrl = [](const std::string& material) {
    return models::scene("a.wrl",
                         "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { " + material + " } } geometry Box { } }")
        .scene.materials.at(0)
        .reflectance;
  };
  CHECK(of_wrl("diffuseColor 0 0 0 specularColor .9 .7 .2") == radiosity::Color(0.9, 0.7, 0.2));
  CHECK(of_wrl("diffuseColor 0 0 0 specularColor .5 .5 .5") == radiosity::Color(0.0));
  const auto of_mgf = [](const std::string& looks) {
    const std::string square = "v a =\n p 0 0 0\nv b =\n p 1 0 0\nv c =\n p 1 1 0\nv d =\n p 0 1 0\n";
    const apps::SceneFile file = models::scene("a.mgf", square + "m x =\n" + looks + "f a b c d\n");
    CHECK(noted(file.notes, "reflect as mirrors is left out") == (looks.find("rd") != std::string::npos));
    return file.scene.materials.at(0).reflectance.x;
  };
  CHECK(of_mgf("rs .4 0\n") == Approx(0.4));
  CHECK(of_mgf("rs .4 0\nrd .2\n") == Approx(0.2));
}

// Files from before Ke write what shines as Ka.
TEST_CASE("MTL: Ka above 1 shines, unless Ke tells or Kd is no share of light either") {
  const auto shines = [](const std::string& library) {
    return read("a.obj", models::room_obj, {{"room.mtl", "newmtl wall\n" + library}}).materials.at(0).emission.x;
  };
  CHECK(shines("Ka 20 10 5\nKd 1 1 1\n") == 20.0 * std::numbers::pi);
  CHECK(shines("Kd 1 1 1\nKa 20 10 5\n") == 20.0 * std::numbers::pi);
  CHECK(shines("Ka 1 1 1\nKd 1 1 1\n") == 0.0);
  CHECK(shines("Ka 20 10 5\nKd 1 1 1\nKe 0 0 0\n") == 0.0);
  CHECK(shines("Ke 3 3 3\nKa 20 10 5\n") == 3.0 * std::numbers::pi);
  CHECK(shines("Ka 255 255 255\nKd 200 200 200\n") == 0.0);
}

TEST_CASE("where nothing shines in a file, what is called a lamp does") {
  const auto lamp_called = [](const std::string& name, const std::string& library = "", const apps::ModelOptions& options = {}) {
    const std::string lamp = "usemtl " + name + "\no lamp\nv 1 2.9 1\nv 2 2.9 1\nv 2 2.9 2\nv 1 2.9 2\nf 9 10 11 12\n";
    const apps::SceneFile file = scene("room.obj", models::room_obj + lamp, {{"room.mtl", library}}, options);
    const bool shines = file.scene.materials.at(1).emission == radiosity::Color(100.0);
    CHECK(noted(file.notes, "does now, with 100 W/m2") == shines);
    return shines;
  };
  for (const char* const name : {"light", "Light.001", "area_light", "LampMat", "mat-bulb 3", "CeilingLight", "Emissive", "lights"}) {
    CAPTURE(name);
    CHECK(lamp_called(name));
  }
  for (const char* const name : {"wood_light", "light_grey", "white light", "lamp stand", "lampshade", "daylight", "mat", "floor"}) {
    CAPTURE(name);
    CHECK_FALSE(lamp_called(name));
  }
  CHECK_FALSE(lamp_called("light", "newmtl wall\nKe 1 1 1\n"));  // something else shines
  apps::ModelOptions dark;
  dark.lamps = {{"light", 0.0}};
  CHECK_FALSE(lamp_called("light", "", dark));
  // Not where everything is called so.
  std::string all = models::room_obj;
  all.replace(all.find("usemtl wall"), 11, "usemtl lamp");
  CHECK_FALSE(noted(scene("lamp.obj", all).notes, "does now"));
}
