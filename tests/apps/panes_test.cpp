// SPDX-License-Identifier: MIT
// Surfaces that let most light through, in each format that can say so: they are left out, and what is left is as without them.

#include <random>
#include <string>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/text.hpp"
#include "gltf_sample.hpp"
#include "models.hpp"
#include "program.hpp"
#include "seed.hpp"

using apps::contains;
using gltf_sample::Sample;
using models::noted;
using models::scene;

namespace {

constexpr const char* left_out = "let most light through";
constexpr const char* is_opaque = "taken as opaque";

// Two squares, one above the other, of the materials "glass" and "wall".
std::string two_squares(const std::string& library) {
  return "mtllib " + library +
         "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "o pane\nusemtl glass\nf 1 2 3 4\no wall\nusemtl wall\nf 5 6 7 8\n";
}

// The names in the file of the objects of the scene; an open surface may have become two objects, one for each side.
std::vector<std::string> names(const apps::SceneFile& file) {
  std::vector<std::string> list;
  for (const radiosity::SceneObject& object : file.scene.objects) {
    const std::string name = object.name.substr(0, object.name.find('.'));
    if (!name.starts_with("studio") && !contains(list, name)) { list.push_back(name); }
  }
  return list;
}

// Is the square of this material of glTF in the scene, and is it said that it is left out or taken as opaque?
struct Seen {
  bool there, told, opaque;
};
Seen seen(const std::string& material) {
  Sample sample;
  sample.nodes =
      "[{\"children\": [1, 2]}, {\"mesh\": 0, \"name\": \"pane\"}, {\"mesh\": 1, \"name\": \"wall\", \"translation\": [0, 0, 1]}]";
  sample.primitive =
      "{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"material\": 0}]}, {\"primitives\": [{\"attributes\": {\"POSITION\": 0}, "
      "\"indices\": 1}";
  sample.more = ", \"materials\": [" + material + "]";
  const apps::SceneFile file = scene("a.gltf", sample.embedded());
  return {names(file) == std::vector<std::string>{"pane", "wall"}, noted(file.notes, left_out), noted(file.notes, is_opaque)};
}

}  // namespace

TEST_CASE("glTF: what lets most light through is left out, what holds most of it back is opaque") {
  const auto blend = [](const std::string& alpha, const std::string& more) {
    return "{\"alphaMode\": \"" + more + "\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [1, 1, 1, " + alpha + "]}}";
  };
  for (const char* const alpha : {"0", "0.2", "0.49"}) {
    CAPTURE(alpha);
    const auto [there, told, opaque] = seen(blend(alpha, "BLEND"));
    CHECK((!there && told && !opaque));
  }
  for (const char* const alpha : {"0.5", "0.9"}) {
    CAPTURE(alpha);
    const auto [there, told, opaque] = seen(blend(alpha, "BLEND"));
    CHECK((there && !told && opaque));
  }
  CHECK_FALSE(seen(blend("0.1", "MASK")).there);
  CHECK_FALSE(seen(blend("0.6", "MASK\", \"alphaCutoff\": 0.7, \"name\": \"x")).there);
  CHECK(seen(blend("0.6", "MASK")).there);
  CHECK(seen(blend("0", "OPAQUE")).there);  // alpha does not count
  const auto transmits = [](const std::string& factor, const std::string& more) {
    return "{\"extensions\": {\"KHR_materials_transmission\": {\"transmissionFactor\": " + factor + "}" + more + "}}";
  };
  CHECK_FALSE(seen(transmits("0.9", "")).there);
  CHECK(seen(transmits("0.3", "")).opaque);
  CHECK(seen(transmits("0.9", ", \"KHR_materials_volume\": {\"thicknessFactor\": 0.1}")).opaque);  // a body of glass
  CHECK(seen("{\"alphaMode\": \"BLEND\", \"emissiveFactor\": [1, 1, 1], \"pbrMetallicRoughness\": {\"baseColorFactor\": [1, 1, 1, 0.1]}}")
            .there);  // a lamp
}

TEST_CASE("glTF: dark one-sided shells called outlines are left out, whatever else is called so is not") {
  const auto left = [](const std::string& name, const std::string& color, const std::string& more) {
    return !seen("{\"name\": \"" + name + "\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [" + color + ", 1]}" + more + "}").there;
  };
  CHECK(left("outline", "0.01, 0.01, 0.02", ""));
  CHECK(left("Hero_Outline.001", "0, 0, 0", ", \"doubleSided\": false"));
  CHECK_FALSE(left("outline", "0.5, 0, 0", ""));
  CHECK_FALSE(left("outline", "0, 0, 0", ", \"doubleSided\": true"));
  CHECK_FALSE(left("out", "0, 0, 0", ""));
}

TEST_CASE("OBJ: d is opacity, Tr what it lacks, with both, d counts, and with a picture nothing is left out") {
  const auto taken = [](const std::string& words) {
    return scene("a.obj", two_squares("a.mtl"), {{"a.mtl", "newmtl glass\nKd 1 1 1\n" + words + "newmtl wall\nKd 0.5\n"}});
  };
  for (const char* const words : {"d 0\n", "d 0.3\n", "Tr 1\n", "Tr 0.7\n", "d 0.2\nTr 0.2\n", "d -halo 0.1\n"}) {
    CAPTURE(words);
    CHECK(names(taken(words)) == std::vector<std::string>{"wall"});
    CHECK(noted(taken(words).notes, "1 polygon lets most light through ('glass'): left out, so that it passes (--opaque)"));
  }
  for (const char* const words : {"", "d 1\n", "d 0.7\n", "Tr 0.2\n", "d 1\nTr 1\n", "d 0\nmap_d leaf.png\n", "d 0.1\nKe 1 1 1\n"}) {
    CAPTURE(words);
    CHECK(names(taken(words)).size() == 2);
    CHECK_FALSE(noted(taken(words).notes, left_out));
  }
}

TEST_CASE("VRML: transparency leaves out faces and solids") {
  const auto taken = [](const std::string& transparency) {
    const std::string look = "appearance Appearance { material Material { transparency " + transparency + " } }";
    return scene("a.wrl", "#VRML V2.0 utf8\nShape { " + look + " geometry Box {} }\nShape { geometry Sphere {} }\nShape { " + look +
                              " geometry IndexedFaceSet { coord Coordinate { point [ 5 0 0, 6 0 0, 6 1 0 ] } coordIndex [ 0 1 2 ] } }");
  };
  CHECK(names(taken("0.3")).size() == 3);
  CHECK(names(taken("0.8")) == std::vector<std::string>{"sphere"});
  CHECK(noted(taken("0.8").notes, "1 polygon and 1 solid let most light through"));
}

TEST_CASE("MGF: td and ts are what passes through") {
  const auto taken = [](const std::string& glass) {
    return scene("a.mgf",
                 "v a =\np 0 0 0\nv b =\np 1 0 0\nv c =\np 1 1 0\nv d =\np 0 0 1\nm wall =\nrd 0.5\no wall\nf a b c\no\nm glass =\n" +
                     glass + "o pane\nf a b d\no\n");
  };
  for (const char* const glass : {"ts 0.9 0\n", "td 0.6\n", "ts 0.3 0\ntd 0.3\n"}) {
    CAPTURE(glass);
    CHECK(names(taken(glass)) == std::vector<std::string>{"wall"});
  }
  for (const char* const glass : {"", "ts 0.4 0\n", "ts 0.9 0\nts 0 0\n"}) {
    CAPTURE(glass);
    CHECK(names(taken(glass)).size() == 2);
  }
  CHECK(noted(taken("ts 0.4 0\n").notes, is_opaque));
}

TEST_CASE("panes: nothing else in the file, or the wish to see them, keeps them") {
  const std::string both = "newmtl glass\nd 0.1\nnewmtl wall\nd 0.1\n";
  const apps::SceneFile all = scene("a.obj", two_squares("a.mtl"), {{"a.mtl", both}});
  CHECK(names(all).size() == 2);
  CHECK_FALSE(noted(all.notes, left_out));
  apps::ModelOptions options;
  options.opaque = true;
  const apps::SceneFile kept = scene("a.obj", two_squares("a.mtl"), {{"a.mtl", "newmtl glass\nd 0.1\n"}}, options);
  CHECK(names(kept).size() == 2);
  CHECK_FALSE(noted(kept.notes, left_out));
}

// A file with panes anywhere among its polygons makes the same scene as the file without them; its polygons keep their numbers.
TEST_CASE("panes: what is left is as if they had never been there") {
  const auto seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 30; ++run) {
    std::string vertices, with, without;
    std::vector<bool> pane;
    for (int i = 0; i < 12; ++i) {
      for (const char* const corner : {"0 0 ", "1 0 ", "1 1 ", "0 1 "}) {
        vertices += "v " + std::string(corner) + std::to_string(i) + "\n";
      }
      const std::string faces = "o thing" + std::to_string(i) + "\nusemtl wall\nf -4 -3 -2 -1\n";
      pane.push_back(i > 0 && random() % 3 == 0);
      with += vertices + (pane.back() ? "usemtl glass\no pane\nf -4 -3 -2 -1\n" : faces);
      without += vertices + (pane.back() ? "" : faces);
      vertices.clear();
    }
    const models::Files files{{"a.mtl", "newmtl glass\nd 0.2\nnewmtl wall\nKd 0.3 0.5 0.7\n"}};
    const apps::SceneFile one = scene("a.obj", "mtllib a.mtl\n" + with, files), two = scene("a.obj", "mtllib a.mtl\n" + without, files);
    REQUIRE(names(one) == names(two));
    for (std::size_t i = 0; i < one.scene.objects.size(); ++i) {
      const raycast::Box a = one.scene.objects[i].shape->bounds(), b = two.scene.objects[i].shape->bounds();
      CHECK((a.lo == b.lo && a.hi == b.hi));
    }
    REQUIRE(one.given);
    REQUIRE(one.given->count() == 12);  // what is exported is the whole file
    for (std::size_t p = 0; p < 12; ++p) {
      CHECK(one.given->parts.of(p).empty() == pane[p]);
      for (const radiosity::PolygonPart& part : one.given->parts.of(p)) {
        CHECK(one.scene.objects[part.object + one.given->first_object].name.starts_with("thing" + std::to_string(p) + "."));
      }
    }
  }
}

TEST_CASE("panes: light comes through a window") {
  // A room with a window in the wall x = 4, and a lamp outside it.
  const std::string room =
      "mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 0 3 0\nv 4 3 0\nv 4 3 4\nv 0 3 4\n"
      "v 4 1 1\nv 4 1 3\nv 4 2 3\nv 4 2 1\nv 9 0 0\nv 9 0 4\nv 9 4 4\nv 9 4 0\n"
      "o room\nusemtl wall\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 4 1 5 8\n"
      "f 2 3 10 9\nf 3 7 11 10\nf 7 6 12 11\nf 6 2 9 12\no window\nusemtl glass\nf 9 10 11 12\no lamp\nusemtl lamp\nf 13 14 15 16\n";
  const program::Place place;
  place.write("a.obj", room);
  place.write("a.mtl", "newmtl wall\nKd 0.5\nnewmtl glass\nd 0.2\nnewmtl lamp\nKe 10\n");
  const program::Run open = place.run("info a.obj"), shut = place.run("info a.obj --opaque");
  INFO(open.out + open.err + shut.out + shut.err);
  CHECK(open.code == 0);
  CHECK(shut.code == 0);
  CHECK(open.out.find("10 polygons became") != std::string::npos);
  CHECK(shut.out.find("11 polygons became") != std::string::npos);
  // A ray from the lamp through the window, in metres with z up, ends in the room at x = 0, or at the window.
  const auto reached = [&](bool opaque) {
    apps::ModelOptions options;
    options.opaque = opaque;
    const apps::SceneFile file =
        scene("a.obj", room, {{"a.mtl", "newmtl wall\nKd 0.5\nnewmtl glass\nd 0.2\nnewmtl lamp\nKe 10\n"}}, options);
    const auto hit = raycast::Scene(radiosity::placed_objects(file.scene)).closest({{8.0, -2.0, 1.5}, {-1.0, 0.0, 0.0}});
    REQUIRE(hit.has_value());
    return 8.0 - hit->t;
  };
  CHECK(reached(false) == Approx(0.0).margin(1e-9));
  CHECK(reached(true) == Approx(4.0).margin(1e-9));
}
