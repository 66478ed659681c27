// SPDX-License-Identifier: MIT
// Lightmaps of exports: at the texture coordinates of a place of the mesh, read as a graphics card reads, is the light of that place.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/models.hpp"
#include "apps/program.hpp"
#include "apps/scene_file.hpp"
#include "catch.hpp"
#include "json.hpp"
#include "texture.hpp"

namespace {

apps::SceneFile model_of(const std::string& text) {
  apps::SceneResult result = apps::parse_scene(text);
  INFO(apps::to_text(result, "scene"));
  REQUIRE(result.file);
  return std::move(*result.file);
}

radiosity::Solution solution_of(const radiosity::Scene& scene) {
  const radiosity::Options options{.epsilon = 0.05, .audit_points = 0, .threads = 1};
  radiosity::Outcome outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}

// Three weights that sum to 1, evenly over a triangle.
glm::dvec3 anywhere(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double a = std::sqrt(unit(random)), b = unit(random);
  return {1.0 - a, a * (1.0 - b), a * b};
}

template <class Vector>
Vector mix(const glm::dvec3& weight, const Vector& a, const Vector& b, const Vector& c) {
  return weight.x * a + weight.y * b + weight.z * c;
}

// RMS of what the texture shows less the light of the mesh there, relative to that of the light, over places of all triangles.
double difference(const apps::ExportMesh& mesh, const radiosity::Picture& map, std::mt19937& random) {
  double square = 0.0, reference = 0.0;
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    for (std::uint32_t k = 2; k < mesh.face(f).size(); ++k) {
      const std::uint32_t c = mesh.first_corner[f];
      const glm::dvec3 weight = anywhere(random);
      const auto light = [&](std::uint32_t i) { return mesh.vertices[mesh.corners[c + i]].radiosity; };
      const auto place = [&](std::uint32_t i) { return glm::dvec2(mesh.coordinates[c + i]); };
      const double here = mix(weight, light(0), light(k - 1), light(k)).x,
                   off = texture::sample(map.radiosity, map.width, map.height, mix(weight, place(0), place(k - 1), place(k))).x - here;
      square += off * off;
      reference += here * here;
    }
  }
  return std::sqrt(square / reference);
}

}  // namespace

// Every sheet is a lamp that reflects nothing, so its light is known, and any other one that showed through would be seen.
TEST_CASE("lightmap: each face has its own light up to its borders, flat or curved, with holes or of many parts") {
  std::ostringstream text;
  for (int i = 0; i < 12; ++i) { text << "material m" << i << " reflectance 0 emission " << i + 1 << "\n"; }
  text << "box b from 0 0 0 to 1 2 3 material m0 {\n sheet x0 material m1\n sheet y1 material m2\n sheet z1 material m3\n}\n"
          "cylinder c base 5 0 0 axis 0 0 2 radius 1 material m4 {\n sheet top material m5\n sheet bottom material m6\n}\n"
          "sphere s center 9 0 0 radius 1 material m7\ntorus t center 13 0 0 axis 0 0 1 radius 1 tube 0.3 material m8\n"
          "difference d material m9 {\n box a from 17 0 0 to 20 1 3\n box w from 18 -1 1 to 19 2 2 material m10\n}\n"
          "disk e center 23 0 0 normal 1 2 3 radius 1 material m11\n";
  const apps::SceneFile file = model_of(text.str());
  const radiosity::Solution solution = solution_of(file.scene);
  for (const double texel : {0.02, 0.3}) {
    apps::ExportMesh mesh = apps::solution_mesh(file, solution, solution.mesh);
    const auto texture = apps::solution_texture(solution, {}, texel, mesh);
    REQUIRE(texture);
    REQUIRE(mesh.coordinates.size() == mesh.corners.size());
    CHECK(texture->texel == texel);
    std::mt19937 random(5);
    // Coordinates are floats, and beside each rectangle lies a ring of one texel with its own light.
    CHECK(difference(mesh, texture->picture, random) < 1e-6);
  }
}

TEST_CASE("lightmap: the finer its texels, the closer to the light of the mesh, on a ball and its shadow as well") {
  const apps::SceneFile file = model_of(
      "material white reflectance 0.6\nmaterial lamp reflectance 0 emission 20\n"
      "box room from 0 0 0 to 2 2 2 inside material white\nsphere ball center 0.6 1.4 0.5 radius 0.3 material white\n"
      "polygon light material lamp {\n vertex 0.7 0.7 1.9\n vertex 0.7 1.3 1.9\n vertex 1.3 1.3 1.9\n vertex 1.3 0.7 1.9\n}\n");
  const radiosity::Solution solution = solution_of(file.scene);
  std::vector<double> off;
  for (const double texel : {0.04, 0.01}) {
    apps::ExportMesh mesh = apps::solution_mesh(file, solution, solution.mesh);
    const auto texture = apps::solution_texture(solution, {}, texel, mesh);
    REQUIRE(texture);
    std::mt19937 random(7);
    off.push_back(difference(mesh, texture->picture, random));
  }
  // The light is linear on each triangle, so a texel errs only at kinks between them, of which a finer texture smears less.
  CHECK(off[1] < 0.5 * off[0]);
  CHECK(off[1] < 0.005);
}

TEST_CASE("lightmap: texels that are larger than asked for are told") {
  const program::Place place;
  const std::string render = "render " + program::scene("two_plates") + " --audit 0 --quiet -o a.glb --lightmap a.hdr --texel ";
  for (const auto& [texel, told] : {std::pair{"1e-9", true}, {"0.05", false}}) {
    const program::Run run = place.run(render + texel);
    CAPTURE(texel, run.out, run.err);
    CHECK(run.code == 0);
    CHECK((run.out.find(" m, larger than asked for") != std::string::npos) == told);
  }
}

TEST_CASE("lightmap: render writes it beside a GLB and an OBJ, of the user's polygons in their order as well") {
  const program::Place place;
  place.write("room.obj", models::room_obj);
  place.write("room.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nKe 0.31830988618 0.31830988618 0.31830988618\n");  // a furnace: B = 2
  const std::string quick = " --quiet --audit 0 --epsilon 0.2 --threads 1 --exposure 0.7853981633974483";
  for (const std::string onto : {"", " --onto-input"}) {
    REQUIRE(place.run("render room.obj -o a.obj -o a.glb --lightmap a.pfm --texel 0.1 --json a.json" + onto + quick).code == 0);
    const std::string pfm = place.read("a.pfm");
    int width = 0, height = 0;
    REQUIRE(std::sscanf(pfm.c_str(), "PF\n%d %d", &width, &height) == 2);
    CHECK(json::parse(place.read("a.json"))["lightmap"]["width"].number() == width);
    const auto texel = [&](double u, double v) {  // the format's rows begin below, as do the coordinates of OBJ
      const auto x = static_cast<std::size_t>(u * width), y = static_cast<std::size_t>(v * height);
      float value = 0.0F;
      const std::size_t at = pfm.size() - 12 * static_cast<std::size_t>(width * height) + 12 * (y * static_cast<std::size_t>(width) + x);
      REQUIRE(at + 4 <= pfm.size());
      std::memcpy(&value, pfm.data() + at, 4);
      return static_cast<double>(value);
    };
    std::istringstream obj(place.read("a.obj"));
    std::size_t coordinates = 0;
    for (std::string line; std::getline(obj, line);) {
      double u = 0.0, v = 0.0;
      if (std::sscanf(line.c_str(), "vt %lf %lf", &u, &v) != 2) { continue; }
      ++coordinates;
      CHECK(texel(u, v) == Approx(2.0 / 3.14159265358979).epsilon(1e-3));
    }
    const apps::Model model = models::read("a.obj", place.read("a.obj"));
    CHECK(coordinates == model.corners.size());
    if (!onto.empty()) { CHECK((coordinates == 24 && model.positions.size() == 8)); }
    const std::string glb = place.read("a.glb");
    CHECK(models::read("a.glb", glb).polygons() == model.corners.size() - 2 * model.polygons());
    for (const std::string part : {"TEXCOORD_0", "baseColorTexture", "a.pfm", "\x89PNG"}) { CHECK(glb.find(part) != std::string::npos); }
    CHECK(glb.find("\"COLOR_0\"") == std::string::npos);
  }
  program::Run run = place.run("render room.obj -o a.png --lightmap a.pfm" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("there is none") != std::string::npos);
  run = place.run("render room.obj -o a.glb --lightmap b.jpg" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("ends with .hdr, .pfm or .png") != std::string::npos);
}
