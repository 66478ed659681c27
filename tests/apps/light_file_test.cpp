// SPDX-License-Identifier: MIT
// Light that was kept in a file: pictures of it are those of the solution, and what is damaged or another scene's is refused.
#include "catch.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>

#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/bytes.hpp"
#include "apps/light_file.hpp"
#include "apps/program.hpp"
#include "apps/scene_file.hpp"

namespace {

const std::string room =
    "material wall reflectance 0.5\nmaterial lamp reflectance 0 emission 5\n"
    "box room from 0 0 0 to 3 2 1 inside material wall\nsphere ball center 1 1 0.3 radius 0.2 material wall\n"
    "polygon lamp material lamp {\n vertex 1 1 0.9\n vertex 1 1.5 0.9\n vertex 1.5 1.5 0.9\n vertex 1.5 1 0.9\n}\n";

radiosity::Scene scene_of(const std::string& text) {
  apps::SceneResult parsed = apps::parse_scene(text);
  REQUIRE(parsed.file);
  return std::move(parsed.file->scene);
}

radiosity::Solution solved(const radiosity::Scene& scene) {
  const radiosity::Options options{.epsilon = 0.1, .min_area = 1e-2, .audit_points = 0};
  radiosity::Outcome outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}

}  // namespace

TEST_CASE("light from a file draws the pictures of the solution, to the bit") {
  const radiosity::Scene scene = scene_of(room);
  const radiosity::Solution solution = solved(scene);
  const apps::LightResult read = apps::read_light_file(apps::to_light_file(solution.mesh, solution.frame, scene, {}), scene);
  INFO(read.reason);
  REQUIRE(read.light);
  for (const glm::dvec3 eye : {glm::dvec3{0.2, 0.2, 0.5}, {2.5, 1.5, 0.7}}) {
    const radiosity::Camera camera{.eye = eye, .forward = glm::dvec3{1.0, 1.0, 0.3} - eye, .field_of_view = 70.0};
    const radiosity::View view = radiosity::make_view(camera, {24, 16});
    const auto picture = [&](const radiosity::Mesh& mesh, const radiosity::Frame& frame) {
      return radiosity::draw(radiosity::FinalGather{scene, mesh, frame}, view, 1.0).value();
    };
    CHECK(picture(read.light->mesh, read.light->frame).radiosity == picture(solution.mesh, solution.frame).radiosity);
    CHECK(radiosity::draw(read.light->mesh, view, 1.0).value().radiosity == radiosity::draw(solution.mesh, view, 1.0).value().radiosity);
    CHECK(radiosity::automatic_exposure(read.light->mesh, scene, view) == radiosity::automatic_exposure(solution.mesh, scene, view));
  }
}

TEST_CASE("light of another scene is refused: other colours, other shapes, other places") {
  const radiosity::Scene scene = scene_of(room);
  const radiosity::Solution solution = solved(scene);
  const std::string file = apps::to_light_file(solution.mesh, solution.frame, scene, {});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = room;
    text.replace(text.find(from), from.size(), to);
    return apps::read_light_file(file, scene_of(text)).reason;
  };
  CHECK(changed("emission 5", "emission 6") == "it holds the light of another scene");
  CHECK(changed("radius 0.2", "radius 0.201") == "it holds the light of another scene");
  CHECK(changed("center 1 1", "center 1.001 1") == "it holds the light of another scene");
}

TEST_CASE("a damaged light file is refused, and one of wrong numbers under a right checksum") {
  const radiosity::Scene scene = scene_of(room);
  const radiosity::Solution solution = solved(scene);
  const std::string file = apps::to_light_file(solution.mesh, solution.frame, scene, {});
  constexpr unsigned seed = 20261123;
  INFO("seed " << seed);
  std::mt19937 random{seed};
  for (int turn = 0; turn < 100; ++turn) {
    std::string damaged = file;
    if (turn % 2 == 0) { damaged.resize(random() % file.size()); }
    if (turn % 2 == 1) { damaged[random() % file.size()] ^= static_cast<char>(1u << random() % 7); }
    CHECK_FALSE(apps::read_light_file(damaged, scene).light);
  }
  // Any word of the body at random: what is read then has no number that names what is not there.
  const std::size_t body = std::string("halflight light 3\n0123456789abcdef\n").size() + 8 + apps::to_bytes({}).size();
  for (int turn = 0; turn < 200; ++turn) {
    std::string changed = file.substr(0, file.size() - 16);
    const std::size_t at = body + (turn < 100 ? random() % 24 : random() % (changed.size() - body - 4));
    const auto word = static_cast<std::uint32_t>(random());
    std::memcpy(changed.data() + at, &word, sizeof(word));
    apps::Checksum sum;
    sum.add(changed);
    const auto read = apps::read_light_file(changed + sum.text(), scene);
    if (turn < 100) { CHECK_FALSE(read.light); }  // the counts
    if (!read.light) { continue; }
    for (const radiosity::MeshCorner& corner : read.light->mesh.corners) { REQUIRE(corner.vertex < read.light->mesh.positions.size()); }
    for (const radiosity::MeshFace& face : read.light->mesh.faces) {
      REQUIRE((face.corner_count == 3 || face.corner_count == 4));
      REQUIRE(std::uint64_t{face.first_corner} + face.corner_count <= read.light->mesh.corners.size());
      REQUIRE(face.surface < radiosity::surfaces(scene).size());
    }
  }
}

TEST_CASE("render keeps light and draws it again") {
  const program::Place place;
  place.write("a.scene", room + "camera one eye 0.2 0.2 0.5 target 1 1 0.3 fov 70\ncamera two eye 2.5 1.5 0.7 target 1 1 0.3 fov 70\n");
  const std::string coarse = " --epsilon 0.1", quick = " --quiet --audit 0 --threads 1 --size 24x16 --exposure 1 --camera two";
  REQUIRE(place.run("render a.scene -o a.light --quiet --audit 0 --threads 1" + coarse).code == 0);
  REQUIRE(place.run("render a.scene -o a.pfm -o for_any_camera.light" + coarse + quick).code == 0);
  CHECK(place.run("render a.scene --light a.light -o b.pfm" + quick).code == 0);
  CHECK(place.read("b.pfm") == place.read("a.pfm"));
  program::Run run = place.run("render a.scene --light a.light -o b.ply" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("--light draws pictures") != std::string::npos);
  run = place.run("render a.scene --light a.scene -o c.pfm" + quick);
  CHECK(run.code == 3);
  CHECK(run.err.find("a.scene: not a .light file") != std::string::npos);
  CHECK_FALSE(place.has("c.pfm"));
}

TEST_CASE("light holds its scene, so that it is drawn from that file alone, from anywhere") {
  const program::Place place;
  place.write("room.obj",
              "mtllib room.mtl\nv 0 0 0\nv 300 0 0\nv 300 0 200\nv 0 0 200\nv 0 100 0\nv 300 100 0\nv 300 100 200\nv 0 100 200\n"
              "usemtl red\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
              "v 100 99 50\nv 100 99 100\nv 150 99 100\nv 150 99 50\nusemtl panel\nf 9 10 11 12\n");
  place.write("room.mtl", "newmtl red\nKd 0.6 0.2 0.2\nnewmtl panel\nKd 0 0 0\n");
  const std::string coarse = " --epsilon 0.1", quick = " --quiet --audit 0 --threads 1 --exposure 1";
  const std::string camera = " --camera 'eye 0.3 -0.3 0.5 target 2 -1.5 0.4 size 24 16'";
  REQUIRE(place.run("render room.obj --units cm --lamp panel=50 -o a.pfm -o a.light" + coarse + quick + camera).code == 0);
  const std::string picture = place.read("a.pfm");
  CHECK(picture.size() > 24 * 16 * 12);
  for (const char* file : {"room.obj", "room.mtl"}) { std::filesystem::remove(place.path() / file); }
  REQUIRE(place.run("render --light a.light -o b.pfm" + quick + camera).code == 0);
  const auto pixels = [&](const std::string& name) {
    const std::string bytes = place.read(name);
    return bytes.substr(bytes.size() - 24 * 16 * 12);
  };
  CHECK(pixels("b.pfm") == pixels("a.pfm"));
  REQUIRE(place.run("render --light a.light -o c.pfm --size 24x16 --camera 'eye 2.5 -1.5 0.5 look -1 0.6 0'" + quick).code == 0);
  CHECK(pixels("c.pfm") != pixels("a.pfm"));
  program::Run run = place.run("render a.light -o d.pfm" + quick);
  CHECK(run.code == 3);
  CHECK(run.err.find("`halflight render --light a.light -o OUT.png` draws a picture of it") != std::string::npos);
  run = place.run("render -o d.pfm");
  CHECK(run.code == 2);
  CHECK(run.err.find("render needs SCENE, the scene: a .scene file") != std::string::npos);
  CHECK_FALSE(place.has("d.pfm"));
}

TEST_CASE("what a scene was read from is read back, and damaged bytes are nothing or sound") {
  constexpr unsigned seed = 20261124;
  INFO("seed " << seed);
  std::mt19937 random{seed};
  const auto text = [&] {
    std::string result(random() % 20, ' ');
    for (char& c : result) { c = static_cast<char>(random()); }
    return result;
  };
  const auto number = [&] { return static_cast<double>(random() % 1000 + 1) / 1100.0; };
  for (int turn = 0; turn < 200; ++turn) {
    apps::SceneSource source{text(), text(), {}, {}};
    for (auto i = random() % 3; i > 0; --i) { source.beside.push_back({text(), {}, text()}); }
    apps::ModelOptions& options = source.options;
    options.reflectance = number();
    options.metres = number();
    options.two_sided = random() % 2 == 0;
    options.merge = random() % 2 == 0;
    if (random() % 2 == 0) { options.up = static_cast<apps::UpAxis>(random() % 3); }
    for (auto i = random() % 3; i > 0; --i) { options.lamps.push_back({text(), number()}); }
    if (random() % 2 == 0) { options.camera = radiosity::Camera{}; }
    const std::string bytes = apps::to_bytes(source);
    const auto read = apps::read_scene_source(bytes);
    REQUIRE(read);
    CHECK(apps::to_bytes(*read) == bytes);
    CHECK(read->options.key() == options.key());
    CHECK_FALSE(apps::read_scene_source(bytes.substr(0, random() % bytes.size())));
    std::string changed = bytes;
    changed[random() % changed.size()] ^= static_cast<char>(1u << random() % 8);
    const auto other = apps::read_scene_source(changed);
    if (other) { CHECK(other->options.metres > 0.0); }
  }
}
