// SPDX-License-Identifier: MIT
// halflight mesh as its user meets it: what is told agrees with what is written, and with geometry.
#include "catch.hpp"

#include <string>

#include "json.hpp"
#include "program.hpp"

using program::Place;
using program::Run;

namespace {

const std::string shapes =
    "material m reflectance 0.5\n"
    "box room from 0 0 0 to 0.3 5 3 inside material m\n"
    "box block from 0.1 0.1 0.1 to 0.2 0.3 0.4 material m\n"
    "torus ring center 9 0 0 axis 0 0 1 radius 2 tube 0.5 material m\n"
    "polygon lamp material m {\n vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0\n vertex 0 1 0\n}\n";

double close_to(double x) { return 1e-12 * x; }  // sums of a few products, each rounded by 2^-53

}  // namespace

TEST_CASE("mesh: counts, genus, area and volume of each object, a room counted negative") {
  const Place place;
  place.write("s.scene", shapes);
  const Run run = place.run("mesh s.scene --json");
  REQUIRE(run.code == 0);
  const json::Value report = json::parse(run.out);
  REQUIRE(report["objects"].size() == 4);
  const json::Value& room = report["objects"][0];
  CHECK(room["name"].string() == "room");
  CHECK(room["vertices"].number() == 8);
  CHECK(room["edges"].number() == 12);
  CHECK(room["faces"].number() == 6);
  CHECK(room["shells"].number() == 1);
  CHECK(room["genus"].number() == 0);
  CHECK(std::abs(room["volume"].number() + 4.5) <= close_to(4.5));
  CHECK(std::abs(room["area"].number() - 2 * (1.5 + 0.9 + 15.0)) <= close_to(40.0));
  const json::Value& ring = report["objects"][2];
  CHECK(ring["genus"].number() == 1);
  CHECK(ring["vertices"].number() - ring["edges"].number() + ring["faces"].number() == 0);
  // Chords within 1 % of the size 7.1 of the torus: between the volumes of the tori whose tube is that much thinner, and the true one.
  CHECK(ring["volume"].number() < 2 * 3.14159266 * 3.14159266 * 2 * 0.25);
  CHECK(ring["volume"].number() > 2 * 3.14159265 * 3.14159265 * 2 * 0.43 * 0.43);
  const json::Value& lamp = report["objects"][3];
  CHECK(lamp["faces"].number() == 1);
  CHECK(lamp["borders"].number() == 1);
  CHECK(lamp["area"].number() == 1.0);
  CHECK(lamp["volume"].is_null());
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i) { area += report["objects"][i]["area"].number(); }
  CHECK(std::abs(report["total"]["area"].number() - area) <= close_to(area));
}

TEST_CASE("mesh: of a mesh without a lamp it tells what the file has, and adds no studio around it") {
  const Place place;
  place.write("cube.obj",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const Run run = place.run("mesh cube.obj --json -o out.obj");
  REQUIRE(run.code == 0);
  const json::Value report = json::parse(run.out);
  REQUIRE(report["objects"].size() == 1);
  CHECK(report["total"]["vertices"].number() == 8);
  CHECK(report["total"]["edges"].number() == 12);
  CHECK(report["total"]["faces"].number() == 6);
  CHECK(report["total"]["volume"].number() == 1.0);
}

TEST_CASE("mesh: the written file has the counts that were told, in the coordinates of the scene") {
  const Place place;
  place.write("s.scene", shapes);
  for (const std::string name : {"a.obj", "a.ply", "a.off"}) {
    const Run run = place.run("mesh s.scene -o " + name + " --json a.json");
    REQUIRE(run.code == 0);
    CHECK(run.out.find("written: " + name) != std::string::npos);
    const json::Value report = json::parse(place.read("a.json"));
    const auto count = [&](const char* key) { return std::to_string(static_cast<int>(report["total"][key].number())); };
    const Run check = place.run("check " + name);
    CHECK(check.out.find(count("vertices") + " vertices, " + count("edges") + " edges, " + count("faces") + " faces") != std::string::npos);
    CHECK(check.out.find("components: " + count("shells") + "\n") != std::string::npos);
  }
  const std::string obj = place.read("a.obj");
  CHECK(obj.find("v 0.1 0.3 0.4\n") != std::string::npos);
  CHECK(obj.find("o ring\n") != std::string::npos);
}

TEST_CASE("mesh: every example scene, as text and JSON, what is written is read back with the same counts, closed where it was told so") {
  const Place place;
  int scenes = 0;
  for (const auto& entry : program::fs::directory_iterator(HALFLIGHT_SCENES)) {
    if (entry.path().extension() != ".scene") { continue; }
    ++scenes;
    const std::string scene = "'" + entry.path().string() + "'";
    CAPTURE(scene);
    const std::string type = scenes % 3 == 0 ? "obj" : scenes % 3 == 1 ? "ply" : "off";
    const Run text = place.run("mesh " + scene);
    REQUIRE(text.code == 0);
    const Run run = place.run("mesh " + scene + " -o a." + type + " --json");
    REQUIRE(run.code == 0);
    const json::Value report = json::parse(run.out);
    const json::Value& total = report["total"];
    bool closed = true;
    for (std::size_t i = 0; i < report["objects"].size(); ++i) {
      const json::Value& object = report["objects"][i];
      const std::string name = object["name"].string();
      CAPTURE(name);
      CHECK(text.out.find("\n  " + name + " ") != std::string::npos);
      if (object["borders"].number() == 0) {
        CHECK(object["vertices"].number() - object["edges"].number() + object["faces"].number() ==
              2 * (object["shells"].number() - object["genus"].number()));
      }
      closed = closed && object["borders"].number() == 0;
      CHECK(object["area"].number() > 0.0);
    }
    const Run check = place.run("check a." + type);
    const auto count = [&](const char* key) { return std::to_string(static_cast<int>(total[key].number())); };
    CHECK(check.out.find(count("vertices") + " vertices, " + count("edges") + " edges, " + count("faces") + " faces") != std::string::npos);
    CHECK(check.out.find("components: " + count("shells") + "\n") != std::string::npos);
    if (closed) { CHECK(check.code == 0); }
  }
  CHECK(scenes >= 10);
}

TEST_CASE("mesh: what cannot be done is told before anything is written") {
  const Place place;
  place.write("s.scene", shapes);
  place.write("bad.scene", "box b from 0 0 0 to 1 1 1\n");
  CHECK(place.run("mesh").code == 2);
  CHECK(place.run("mesh s.scene -o a.stl").code == 2);
  CHECK(place.run("mesh s.scene -o a.obj --json ./a.obj").code == 2);
  CHECK(place.run("mesh s.scene --json s.scene").code == 2);
  CHECK(place.run("mesh s.scene -o none/a.obj").code == 1);
  CHECK(place.run("mesh none.scene -o a.obj").code == 1);
  const Run run = place.run("mesh bad.scene -o a.obj");
  CHECK(run.code == 3);
  CHECK(run.err.find("bad.scene:1:5: error: ") == 0);
  CHECK(place.entries() == 2);
}
