// SPDX-License-Identifier: MIT
// Lights without a surface: what their lamps send to a floor is what the file says, in every format.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/spot_cup.hpp"
#include "catch.hpp"
#include "gltf_sample.hpp"
#include "lit_floor.hpp"
#include "models.hpp"

using lit_floor::Dice;
using lit_floor::Floor;
using models::noted;

namespace {

constexpr double side = 20.0;  // of the floor, from the origin to (side, -side, 0) with z up; in files, where y is up, z = -y
const double half_size = side / std::sqrt(2.0);

struct Light {
  std::string type = "point";  // the words of glTF
  glm::dvec3 at{0.0}, direction{0.0, 0.0, -1.0};
  double intensity = 1.0, inner = 0.0, outer = 0.8, drop_off = 0.02;

  // A floor under this light. Of VRML, a relative intensity of 1 is 100 W/m2 at half the size of the floor.
  [[nodiscard]] std::string gltf() const {
    gltf_sample::Sample sample;
    const glm::dquat turn(glm::dvec3(0, 0, -1), glm::normalize(in_file(direction)));
    std::ostringstream nodes, more;
    nodes.precision(17);
    more.precision(17);
    // The square of the sample lies in the plane z = 0 of the file: turned, it faces up.
    nodes << "[{\"children\": [1, 2]}, {\"mesh\": 0, \"scale\": [" << side << ", " << side << ", 1], \"rotation\": [" << -std::sqrt(0.5)
          << ", 0, 0, " << std::sqrt(0.5) << "], \"translation\": [0, 0, " << side << "]}, {\"translation\": [" << at.x << ", " << at.z
          << ", " << -at.y << "], \"rotation\": [" << turn.x << ", " << turn.y << ", " << turn.z << ", " << turn.w
          << "], \"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}}]";
    more << ", \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"" << type << "\", \"intensity\": " << intensity
         << ", \"spot\": {\"innerConeAngle\": " << inner << ", \"outerConeAngle\": " << outer << "}}]}}";
    sample.nodes = nodes.str();
    sample.more = more.str();
    return sample.embedded();
  }
  [[nodiscard]] std::string vrml(bool v97) const {
    std::ostringstream out;
    out.precision(17);
    const double one = type == "directional" ? 100.0 : 100.0 * half_size * half_size;
    const std::string name = type == "point" ? "PointLight" : type == "spot" ? "SpotLight" : "DirectionalLight";
    const glm::dvec3 p = in_file(at), d = in_file(direction);
    std::ostringstream fields;
    fields.precision(17);
    fields << name << " { intensity " << intensity / one;
    if (type != "directional") { fields << " location " << p.x << ' ' << p.y << ' ' << p.z; }
    if (type != "point") { fields << " direction " << d.x << ' ' << d.y << ' ' << d.z; }
    if (type == "spot") {
      fields << " cutOffAngle " << outer << (v97 ? " beamWidth " + std::to_string(inner) : " dropOffRate " + std::to_string(drop_off));
    }
    fields << " }";
    const std::string points = "point [ 0 0 0, 0 0 20, 20 0 20, 20 0 0 ]", faces = "coordIndex [ 0, 1, 2, 3, -1 ]";
    if (v97) {
      out << "#VRML V2.0 utf8\n"
          << fields.str() << " Shape { geometry IndexedFaceSet { coord Coordinate { " << points << " } " << faces << " } }";
    } else {
      out << "#VRML V1.0 ascii\nSeparator { " << fields.str() << " ShapeHints { vertexOrdering COUNTERCLOCKWISE } Coordinate3 { " << points
          << " } IndexedFaceSet { " << faces << " } }";
    }
    return out.str();
  }
  static glm::dvec3 in_file(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }
};

std::vector<apps::SceneFile> in_all_formats(const Light& light) {
  std::vector<apps::SceneFile> files;
  files.push_back(models::scene("a.gltf", light.gltf()));
  files.push_back(models::scene("a.wrl", light.vrml(false)));
  files.push_back(models::scene("a.wrl", light.vrml(true)));
  return files;
}

}  // namespace

TEST_CASE("a light at a point: the floor gets I cos t / r^2, and the lamp never sticks in it") {
  Dice dice;
  INFO("seed " << dice.seed);
  for (int round = 0; round < 4; ++round) {
    Light light;
    light.at = dice.above_floor(0.02, 4.0);
    light.intensity = dice.between(1.0, 1000.0);
    for (const apps::SceneFile& file : in_all_formats(light)) {
      CHECK(noted(file.notes, "1 light has no surface: a lamp of"));
      CHECK(file.warnings.empty());
      const raycast::Box lamp = file.scene.objects.back().shape->bounds();
      CHECK(lamp.lo.z > 0.85 * light.at.z);
      CHECK(lamp.size().x <= 0.0401);
      Floor floor(file);
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 p = dice.on_floor(), way = light.at - p;
        CAPTURE(round, light.at.x, light.at.y, light.at.z, p.x, p.y);
        const double r = glm::length(way);
        CHECK(floor.irradiance(p) == test::Approx(light.intensity * way.z / (r * r * r)).epsilon(0.02));
      }
    }
  }
}

TEST_CASE("a light in the floor hangs close to it") {
  Light light;
  light.at = {8.0, -9.0, 0.0};
  light.intensity = 10.0;
  for (const apps::SceneFile& file : in_all_formats(light)) {
    const raycast::Box lamp = file.scene.objects.back().shape->bounds();
    const bool single = file.scene.objects.size() == 2;  // else the floor has two sides
    CHECK((lamp.lo.z > 0.0 || (!single && lamp.hi.z < 0.0)));
    CHECK(std::max(std::abs(lamp.lo.z), std::abs(lamp.hi.z)) < 0.02);
  }
}

TEST_CASE("lights at one place are one lamp, lights close to each other have smaller ones, and what cannot shine is told") {
  // Of VRML, a relative intensity of 1 is 100 W/m2 at half the size of the floor.
  const auto taken = [](const std::string& lights) {
    return models::scene("a.wrl", "#VRML V1.0 ascii\nSeparator { " + lights +
                                      " Coordinate3 { point [ 0 0 0, 0 0 20, 20 0 20, 20 0 0 ] } IndexedFaceSet { coordIndex "
                                      "[ 0, 1, 2, 3, -1 ] } }");
  };
  const auto lamps = [](const apps::SceneFile& file) {
    return std::count_if(file.scene.objects.begin(), file.scene.objects.end(),
                         [](const radiosity::SceneObject& object) { return object.name.substr(0, 5) == "light"; });
  };
  const auto power = [](const apps::SceneFile& file) {
    double sum = 0.0;
    for (const radiosity::SceneObject& object : file.scene.objects) {
      const double radius = 0.5 * object.shape->bounds().size().x;
      if (object.name.substr(0, 5) == "light") { sum += radius * radius * file.scene.materials[object.material[0]].emission.x; }
    }
    return sum;
  };
  Dice dice;
  INFO("seed " << dice.seed);
  std::string same, apart;
  const double gap = dice.between(0.01, 0.15);
  for (int k = 0; k < 20; ++k) {
    const auto at = [&](double x) { return "PointLight { intensity 0.5 location " + std::to_string(x) + " 3 10 } "; };
    same += at(10.0);
    apart += at(5.0 + gap * k);
  }
  CHECK(lamps(taken(same)) == 1);
  CHECK(power(taken(same)) == test::Approx(20 * 0.5 * 100.0 * half_size * half_size).epsilon(1e-9));
  const apps::SceneFile row = taken(apart);
  CHECK(lamps(row) == 20);
  CHECK(power(row) == test::Approx(power(taken(same))).epsilon(1e-9));
  for (const radiosity::SceneObject& object : row.scene.objects) {
    if (object.name.substr(0, 5) == "light") { CHECK(object.shape->bounds().size().x == test::Approx(0.2 * gap).epsilon(1e-3)); }
  }
  const apps::SceneFile dark =
      taken("PointLight { intensity 0 } SpotLight { direction 0 0 0 } DirectionalLight { direction 0 0 0 } " + same);
  CHECK(noted(dark.notes, "3 lights are left out"));
}

TEST_CASE("a directional light: everywhere the floor gets E cos t, from a sun half a degree wide") {
  Dice dice;
  INFO("seed " << dice.seed);
  for (int round = 0; round < 4; ++round) {
    Light light;
    light.type = "directional";
    light.direction = dice.downwards(0.95);
    light.intensity = dice.between(1.0, 1000.0);
    for (const apps::SceneFile& file : in_all_formats(light)) {
      CHECK(noted(file.notes, "1 directional light became a sun half a degree wide"));
      CHECK_FALSE(noted(file.notes, "studio"));
      CHECK(file.suns == std::vector<std::uint32_t>{static_cast<std::uint32_t>(file.scene.objects.size() - 1)});
      Floor floor(file);
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 p = dice.on_floor();
        CAPTURE(round, light.direction.x, light.direction.y, p.x, p.y);
        CHECK(floor.irradiance(p) == test::Approx(light.intensity * -light.direction.z).epsilon(0.02));
      }
    }
  }
}

TEST_CASE("a directional light comes from the same direction everywhere, to a fifteenth of the sun's width, and as strong to 2e-3") {
  Dice dice;
  INFO("seed " << dice.seed);
  constexpr double width = 0.5 * std::numbers::pi / 180.0;
  for (int round = 0; round < 20; ++round) {
    Light light;
    light.type = "directional";
    light.direction = dice.downwards(0.95);
    for (const apps::SceneFile& file : in_all_formats(light)) {
      REQUIRE(file.suns.size() == 1);
      const raycast::Box sun = file.scene.objects[file.suns.front()].shape->bounds();
      const glm::dvec3 direction = glm::normalize(light.direction);
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 to_sun = sun.centre() - dice.on_floor();
        CAPTURE(round, light.direction.x, light.direction.y);
        CHECK(glm::length(glm::normalize(to_sun) + direction) < width / 15.0);
        const glm::dvec3 from_middle = sun.centre() - glm::dvec3{10.0, -10.0, 0.0};
        CHECK(glm::dot(to_sun, to_sun) == test::Approx(glm::dot(from_middle, from_middle)).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("lights that end at a distance in their file, or fade otherwise than with its square, are told") {
  const auto told = [](const std::string& name, const std::string& text) {
    return noted(models::scene(name, text).notes, "1 light: not the reach and fading of the file");
  };
  const auto with = [](std::string text, const std::string& before, const std::string& more) {
    return text.insert(text.find(before), more);
  };
  const Light light;
  CHECK_FALSE(told("a.gltf", light.gltf()));
  CHECK(told("a.gltf", with(light.gltf(), "\"intensity\"", "\"range\": 3, ")));
  CHECK_FALSE(told("a.wrl", light.vrml(false)));
  CHECK(told("a.wrl", light.vrml(true)));  // the default is no fading at all
  CHECK(told("a.wrl", with(light.vrml(true), "intensity", "attenuation 0 1 1 ")));
  CHECK_FALSE(told("a.wrl", with(light.vrml(true), "intensity", "attenuation 0 0 1 ")));
}

TEST_CASE("a spot light: what falls on the floor, over all directions, is what the file says, and nothing falls outside of the cone") {
  Dice dice;
  INFO("seed " << dice.seed);
  int beyond = 0;
  for (int round = 0; round < 6; ++round) {
    Light light;
    light.type = "spot";
    light.at = dice.above_floor(1.0, 4.0);
    light.direction = dice.downwards(0.7);
    light.intensity = dice.between(1.0, 1000.0);
    light.outer = dice.between(0.1, round == 0 ? 0.5 : 1.4);  // all of the floor may lie in a wide cone
    light.inner = dice.between(0.0, 0.95) * light.outer;
    const auto full = [&](const glm::dvec3& p) {
      const glm::dvec3 way = light.at - p;
      return light.intensity * way.z / std::pow(glm::length(way), 3.0);
    };
    const glm::dvec3 axis = glm::normalize(light.direction), middle = light.at - light.at.z / axis.z * axis;
    const glm::dvec3 u = glm::normalize(glm::cross(axis, {1.0, 0.2, 0.1})), v = glm::cross(axis, u);
    const std::array fades{apps::ModelLight::Fade::squared_cosine, apps::ModelLight::Fade::power_of_cosine,
                           apps::ModelLight::Fade::by_angle};
    const std::vector<apps::SceneFile> files = in_all_formats(light);
    for (std::size_t f = 0; f < files.size(); ++f) {
      CHECK(noted(files[f].notes, "1 spot light became a small lamp in a black cup"));
      apps::ModelLight in_file;
      in_file.inner = light.inner;
      in_file.outer = light.outer;
      in_file.fade = fades[f];
      in_file.power = 128.0 * light.drop_off;
      Floor floor(files[f]);
      CAPTURE(round, f, light.at.z, axis.x, axis.y, light.inner, light.outer, light.drop_off);
      CHECK(noted(files[f].warnings, "1 spot light sends as much light as in the file") == (apps::spot_cup(in_file).difference > 0.005));
      CHECK(floor.irradiance(middle) == test::Approx(full(middle)).epsilon(0.02));
      double found = 0.0, expected = 0.0, off = 0.0, squares = 0.0;
      constexpr int directions = 400;
      bool all_meet_floor = true;
      for (int k = 0; k < directions; ++k) {  // evenly over the cosines, at golden angles around the axis
        const double cosine = 1.0 - (1.0 - std::cos(1.1 * light.outer)) * (k + 0.5) / directions, around = 2.399963 * k;
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const glm::dvec3 way = cosine * axis + sine * (std::cos(around) * u + std::sin(around) * v);
        const glm::dvec3 p = light.at - light.at.z / way.z * way;
        if (way.z > -0.1 || p.x < 0.5 || p.x > 19.5 || p.y > -0.5 || p.y < -19.5) {
          all_meet_floor = false;
          continue;
        }
        // The inner cone is lit in full; VRML 1.0 has none, and that of VRML 2.0 has an edge where the light begins to fall.
        if (f == 0 && std::acos(cosine) < 0.95 * light.inner) { CHECK(floor.irradiance(p) == test::Approx(full(p)).epsilon(0.02)); }
        const double share = floor.irradiance(p) / full(p), given = apps::spot_intensity(in_file, std::acos(cosine));
        found += share;
        expected += given;
        off += (share - given) * (share - given);
        squares += given * given;
      }
      CAPTURE(found / expected, std::sqrt(off / squares));
      CHECK(std::sqrt(off / squares) < apps::spot_cup(in_file).difference + 0.05);  // the cup is a prism, 4 cm wide in a height of 1 m
      if (all_meet_floor) { CHECK(found == test::Approx(expected).epsilon(0.03)); }
      for (int k = 0; k < 100; ++k) {
        const glm::dvec3 p = dice.on_floor(), way = glm::normalize(p - light.at);
        const double angle = std::acos(std::clamp(glm::dot(way, axis), -1.0, 1.0));
        CAPTURE(p.x, p.y, angle);
        CHECK(floor.irradiance(p) <= 1.02 * full(p));
        if (angle > light.outer + 0.05) {
          ++beyond;
          CHECK(floor.irradiance(p) <= 1e-3 * full(p));
        }
      }
    }
  }
  CHECK(beyond > 0);
}

TEST_CASE("a directional light lights no closed room: that gets a lamp") {
  // A box with a camera in it, its sides counterclockwise from there.
  const std::string box =
      "ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID } Coordinate3 { point [ 0 0 0, 4 0 0, 4 3 0, 0 3 0, 0 0 5, 4 0 5, "
      "4 3 5, 0 3 5 ] } IndexedFaceSet { coordIndex [ 0,1,2,3,-1, 4,7,6,5,-1, 0,4,5,1,-1, 3,2,6,7,-1, 0,3,7,4,-1, 1,5,6,2,-1 ] }";
  const apps::SceneFile dark = models::scene(
      "a.wrl",
      "#VRML V1.0 ascii\nSeparator { DirectionalLight { direction 0.3 -1 0.2 } PerspectiveCamera { position 2 1.5 2.5 } " + box + " }");
  CHECK(noted(dark.notes, "1 directional light became a sun"));
  CHECK(noted(dark.notes, "nothing shines in this closed room"));
}

TEST_CASE("the mesh to export has no sun, and keeps all else") {
  Light light;
  light.type = "directional";
  const apps::SceneFile file = models::scene("a.gltf", light.gltf());
  const radiosity::Outcome outcome = radiosity::solve(file.scene, {.epsilon = 0.5, .min_area = 0.01, .audit_points = 0});
  REQUIRE(outcome.solution);
  const radiosity::Mesh& all = outcome.solution->shown();
  const radiosity::Mesh near = apps::without_suns(file, all);
  raycast::Box box;
  for (const glm::dvec3& p : near.positions) { box.extend(p); }
  CHECK(glm::length(box.size() - glm::dvec3(side, side, 0.0)) < 1e-9);
  const auto of_floor = [](const radiosity::MeshFace& face) { return face.surface == 0; };
  CHECK(std::count_if(all.faces.begin(), all.faces.end(), of_floor) == std::ssize(near.faces));
}
