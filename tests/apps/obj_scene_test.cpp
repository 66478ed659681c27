// SPDX-License-Identifier: MIT
// OBJ with MTL, PLY and OFF as scenes; what the command line may say about files of other programs.

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/scene.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/bounds.hpp>

#include "models.hpp"
#include "program.hpp"
#include "seed.hpp"

using models::noted;
using models::read;
using models::scene;

TEST_CASE("OBJ: faces know their group and their material, materials their colours") {
  const apps::Model model =
      read("a.obj",
           "mtllib one.mtl two.mtl\nmtllib my own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
           "f 1 2 3\no table\ng leg\nusemtl red paint\nf -4 -3 -1\ng top\nusemtl glow\nf 2 3 4\no chair\nusemtl nobody\nf 1 3 4\n",
           {{"one.mtl", "newmtl  red  paint\nKd 0.5 0.25 0.125 # a comment\nnewmtl other\nKd 1 1 1\n"},
            {"two.mtl", "newmtl glow\nKd 0.2\nKe 1 2 3\nmap_Kd a b.png\nd 0.5\n"},
            {"my own.mtl", "newmtl default\nKd x y z\nKd 0.5 -1 0\n"}});
  REQUIRE(model.polygons() == 4);
  CHECK(model.groups == std::vector<std::string>{"mesh", "table.leg", "table.top", "chair"});
  CHECK(model.group == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(model.material == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(model.line == std::vector<std::uint32_t>{7, 11, 14, 17});
  REQUIRE(model.materials.size() == 4);
  CHECK(model.materials[0].name == "default");
  CHECK_FALSE(model.materials[0].reflectance);
  CHECK(model.materials[1].name == "red paint");
  CHECK(model.materials[1].reflectance == radiosity::Color(0.5, 0.25, 0.125));
  CHECK(model.materials[2].reflectance == radiosity::Color(0.2));
  CHECK(model.materials[2].emission.z == 3.0 * std::numbers::pi);
  CHECK_FALSE(model.materials[3].reflectance);
  CHECK(noted(model.notes, "textures are not read"));
  CHECK(noted(model.notes, "taken as opaque, at two.mtl:5"));
  CHECK(noted(model.notes, "numbers from 0 on after Kd: passed over, 2 times, first at my own.mtl:2"));

  const apps::Model without = read("a.obj", models::room_obj);
  CHECK(noted(without.notes, "the materials in 'room.mtl' are not known: it is not there"));
  CHECK(models::error("a.obj", "v 0 0 0\nf 1 2 3\n").find(":2:5: error: there is no vertex 2") == 0);
}

// In a closed room in which everything shines with E and reflects rho, the radiosity is E / (1 - rho) everywhere.
TEST_CASE("OBJ: furnace") {
  const apps::SceneFile file = scene("room.obj", models::room_obj, {{"room.mtl", "newmtl wall\nKd 0.5\nKe 2\n"}});
  REQUIRE(file.scene.objects.size() == 1);
  CHECK(file.scene.objects[0].placement.inside);
  const radiosity::Options options{.audit_points = 0, .threads = 1};
  const radiosity::Outcome outcome = radiosity::solve(file.scene, options);
  REQUIRE(outcome.solution);
  for (const radiosity::SurfaceMean& surface : outcome.solution->audit.surfaces) {
    CHECK(surface.radiosity.x == Approx(2.0 * std::numbers::pi / (1.0 - 0.5)).epsilon(1e-7));
  }
}

// White of 1 stands for paint, of .95.
TEST_CASE("MTL: what reflects nearly all is kept, what would reflect all is darkened with its colour kept") {
  const auto taken = [](const std::string& kd) {
    const apps::SceneFile file = scene("room.obj", models::room_obj, {{"room.mtl", "newmtl wall\nKd " + kd + "\nKe 2\n"}});
    return std::pair{file.scene.materials.at(file.scene.materials.size() - 1).reflectance, noted(file.notes, "darkened to 0.95")};
  };
  for (const double given : {0.5, 0.95, 0.97, 0.99}) {
    CHECK(taken(std::to_string(given)).first.x == Approx(given).epsilon(1e-12));
    CHECK_FALSE(taken(std::to_string(given)).second);
  }
  for (const double given : {0.991, 1.0, 2.0}) {
    const auto [reflectance, told] = taken(std::to_string(given) + " " + std::to_string(0.5 * given) + " 0");
    CHECK(told);
    CHECK(reflectance.x == Approx(0.95).epsilon(1e-12));
    CHECK(reflectance.y == Approx(0.475).epsilon(1e-12));
    CHECK(reflectance.z == 0.0);
  }
}

TEST_CASE("units, the up axis, reflectance and lamps come from the command line") {
  const std::string lamp = models::room_obj + "usemtl ceiling lamp\no lamp\nv 1 2.9 1\nv 2 2.9 1\nv 2 2.9 2\nv 1 2.9 2\nf 9 10 11 12\n";
  apps::ModelOptions options;
  options.lamps = {{"ceiling lamp", 40.0}};
  options.metres = 0.01;
  options.reflectance = 0.3;
  const apps::SceneFile file = scene("room.obj", lamp, {}, options);
  REQUIRE(file.scene.materials.size() == 2);
  CHECK(file.scene.materials[0].reflectance == radiosity::Color(0.3));
  CHECK(file.scene.materials[1].emission == radiosity::Color(40.0));
  CHECK(file.scene.objects[0].placement.inside);  // around its lamp
  CHECK(file.scene.objects[0].shape->bounds().hi.z == Approx(0.03));
  CHECK(file.scene.objects[0].shape->bounds().lo.y == Approx(-0.04));
  CHECK(noted(file.notes, "2 materials have no reflectance: 0.3"));
  options.up = apps::UpAxis::z;
  CHECK(scene("room.obj", lamp, {}, options).scene.objects[0].shape->bounds().hi.y == Approx(0.03));

  std::vector<std::string> faults;
  options.lamps = {{"ceiling lmap", 1.0}};
  CHECK_FALSE(apps::to_scene(read("room.obj", lamp), apps::UpAxis::y, options, faults));
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].find("did you mean 'ceiling lamp'?") != std::string::npos);

  CHECK(apps::parse_lamp("a=b=2.5")->material == "a=b");
  CHECK(apps::parse_lamp("a b")->exitance == 100.0);
  for (const char* wrong : {"", "=2", "a=", "a=x", "a=-1", "a=nan", "a=1e300"}) { CHECK_FALSE(apps::parse_lamp(wrong)); }
  CHECK(apps::parse_unit("ft") == 0.3048);
  CHECK(apps::parse_unit("0.5") == 0.5);
  for (const char* wrong : {"", "0", "-1", "inch", "1e13", "m "}) { CHECK_FALSE(apps::parse_unit(wrong)); }
}

TEST_CASE("MTL: a library is looked for beside the file, too, and what only a lost picture shows is not black") {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\nusemtl soot\nf 2 3 1\n";
  const models::Files files{{"house.mtl", "newmtl wood\nKd 0 0 0\nmap_Kd C:\\pictures\\wood.png\nnewmtl soot\nKd 0 0 0\n"}};
  for (const char* library : {"house.mtl", "models/house.mtl", "C:\\Users\\me\\house.mtl", "../a b/house.mtl"}) {
    const apps::Model model = read("a.obj", std::string("mtllib ") + library + "\n" + text, files);
    REQUIRE(model.materials.size() == 2);
    CHECK_FALSE(model.materials[0].reflectance.has_value());
    REQUIRE(model.materials[1].reflectance.has_value());
    CHECK(*model.materials[1].reflectance == radiosity::Color(0.0));
  }
}

TEST_CASE("MTL: words count in upper and lower case, and a colour may be followed by an opacity") {
  for (const char* const words :
       {"Kd 0.5 0.25 0.125\nKe 1 2 3\nd 0.6\n", "kd 0.5 0.25 0.125 0.3\nke 1 2 3 1\nD 0.6\n", "KD 0.5 0.25 0.125\nKE 1 2 3\nTR 0.4\n"}) {
    CAPTURE(words);
    const apps::ModelMaterial wall = read("a.obj", models::room_obj, {{"room.mtl", std::string("newmtl wall\n") + words}}).materials.at(0);
    CHECK(wall.reflectance == radiosity::Color(0.5, 0.25, 0.125));
    CHECK(wall.emission.z == 3.0 * std::numbers::pi);
    CHECK(wall.opacity == Approx(0.6));
  }
}

TEST_CASE("MTL: names of pictures may contain blanks, behind any options") {
  for (const char* const options :
       {"", "-s 1 2 1 ", "-s 2 ", "-o 0 0 -clamp on ", "-mm 0 1 -blendu off -bm 0.5 ", "-t 0 0 0 -imfchan r "}) {
    std::vector<std::string> asked;
    const apps::SideFile record = [&](const std::string& name, std::string& fault) -> std::optional<std::string> {
      asked.push_back(name);
      fault = "is not there";
      return name == "room.mtl" ? std::optional(std::string("newmtl wall\nmap_Kd ") + options + "my red wall.png\n") : std::nullopt;
    };
    CAPTURE(options);
    CHECK(models::format("a.obj").read(models::room_obj, record).model);
    CHECK(asked == std::vector<std::string>{"room.mtl", "my red wall.png"});
  }
}

TEST_CASE("OBJ: a material that no library defines is told, if there are libraries") {
  const std::string of_two = models::room_obj + "usemtl paint\nf 1 2 3\n";
  CHECK(noted(read("a.obj", of_two, {{"room.mtl", "newmtl wall\nKd 0.5\n"}}).notes,
              "materials are not defined in the libraries of the file, 'paint'"));
  CHECK_FALSE(noted(read("a.obj", of_two, {{"room.mtl", "newmtl wall\nnewmtl paint\n"}}).notes, "not defined"));
  CHECK_FALSE(noted(read("a.obj", of_two).notes, "not defined"));
  CHECK_FALSE(
      noted(read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib \"room.mtl\"\nf 1 2 3\n", {{"room.mtl", "newmtl wall\n"}}).notes, "not"));
}

TEST_CASE("files beside a file are found under names that differ only in upper and lower case, if there is only one") {
  const program::Place place;
  place.write("room.obj", models::room_obj);
  place.write("Room.MTL", "newmtl wall\nKd 0.25\nKe 1\n");
  CHECK(place.run("info room.obj").out.find("reflectance 0.25") != std::string::npos);
  place.write("ROOM.MTL", "newmtl wall\nKd 0.75\nKe 1\n");
  CHECK(place.run("info room.obj").out.find("are not known") != std::string::npos);
  place.write("room.mtl", "newmtl wall\nKd 0.5\nKe 1\n");
  CHECK(place.run("info room.obj").out.find("reflectance 0.5") != std::string::npos);
  place.write("b.mtl", "newmtl wall\nKd 0.125\nKe 1\n");
  place.write("b.obj", "mtllib B.Mtl\n" + models::room_obj.substr(models::room_obj.find('\n') + 1));
  CHECK(place.run("info b.obj").out.find("reflectance 0.125") != std::string::npos);
}

TEST_CASE("a model without a lamp stands in a studio, what is closed around it cannot be lit from there") {
  const apps::SceneFile file = scene("a.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  REQUIRE(file.scene.objects.size() == 3);
  CHECK(file.scene.objects[0].name == "studio");
  CHECK(file.scene.objects[1].shape->solid());
  CHECK(file.cameras.size() == 1);
  CHECK(noted(file.notes, "nothing shines in this file"));

  const std::string room =
      "#VRML V1.0 ascii\nGroup { PerspectiveCamera { position 0 0 0.5 }\nCoordinate3 { point [ -1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1, "
      "-1 -1 1, 1 -1 1, 1 1 1, -1 1 1 ] }\nIndexedFaceSet { coordIndex [ 0 1 2 3 -1 4 7 6 5 -1 0 4 5 1 -1 1 5 6 2 -1 2 6 7 3 "
      "-1 3 7 4 0 -1 ] } }";
  const apps::SceneFile lit = scene("a.wrl", room);
  REQUIRE(lit.scene.objects.size() == 2);
  CHECK(lit.scene.objects[0].placement.inside);
  CHECK(
      noted(lit.notes, "nothing shines in this closed room: a lamp of 100 W/m2 hangs under its ceiling; to have lamps of its own: --lamp"));
  // From -1 to 1 in each direction: under the middle of the ceiling.
  const raycast::Box lamp = lit.scene.objects[1].shape->bounds();
  CHECK(glm::length(glm::dvec2(lamp.centre())) < 1e-9);
  CHECK((lamp.hi.z > 0.5 && lamp.hi.z < 1.0));
  CHECK(lit.scene.objects[1].shape->project(0, lamp.centre()).normal.z == test::Approx(-1.0));
}

// A file of OBJ, OFF or PLY does not say which sides are seen; glTF does.
TEST_CASE("a model without a lamp is seen in its studio, whichever way its surfaces are wound and lie") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
  for (int run = 0; run < 50; ++run) {
    std::string triangle;
    glm::dvec3 middle(0.0);
    const double height = run % 5 == 0 ? 0.0 : 1.0;  // some lie flat
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 p(number(), height * number(), number());
      triangle += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
      middle += glm::dvec3(p.x, -p.z, p.y) / 3.0;  // y is up in the file
    }
    for (const char* face : {"f 1 2 3\n", "f 1 3 2\n"}) {
      CAPTURE(triangle, face);
      const apps::SceneFile file = scene("a.obj", triangle + face);
      REQUIRE(file.cameras.size() == 1);
      const auto hit = raycast::Scene(radiosity::placed_objects(file.scene)).closest({file.cameras[0].eye, middle - file.cameras[0].eye});
      REQUIRE(hit.has_value());
      CHECK(file.scene.objects[hit->object].name.starts_with("mesh"));
    }
  }
}

TEST_CASE("a mesh of a scene may be a file of another program, groups use it in many places") {
  const models::Files files{
      {"my room.obj", models::room_obj}, {"room.mtl", "newmtl wall\nKd 0.25\n"}, {"bad.obj", "v 0 0\n"}, {"x.txt", "?"}};
  const std::string head = "material m reflectance 0.5 emission 1\nsphere s center 0 0 0 radius 1 material m\n";
  const auto parse = [&](const std::string& text) { return apps::parse_scene(head + text, models::beside(files)); };
  const auto result =
      parse("define g { mesh a file \"my room.obj\" scale 2 }\nuse g as one move 10 0 0\nuse g as two\nmesh b file bad.obj material m\n");
  CHECK_FALSE(result.file);
  CHECK(apps::to_text(result, "s") == "s:6:13: error: bad.obj:1:6: expected a coordinate, found the end of the line; a vertex has three\n");
  const auto good = parse(
      "define g { mesh a file \"my room.obj\" scale 2 }\nuse g as one move 10 0 0\nuse g as two move 0 0 20\nmesh b file \"my room.obj\" "
      "material m\n");  // neither use holds b, which shines
  INFO(apps::to_text(good, "s"));
  REQUIRE(good.file);
  const auto& objects = good.file->scene.objects;
  REQUIRE(objects.size() == 4);
  CHECK(objects[1].name == "one.a.room");
  CHECK(objects[1].shape == objects[2].shape);  // made once
  CHECK(objects[1].placement.translation == glm::dvec3(10, 0, 0));
  CHECK(good.file->scene.materials[objects[1].material[0]].name == "a.wall");
  CHECK(good.file->scene.materials[objects[1].material[0]].reflectance == radiosity::Color(0.25));
  CHECK(objects[3].material == std::vector<std::uint32_t>{0});
  // A sheet has a back, too, when that is asked for; a material for all covers both.
  const auto sides = [&](const std::string& clauses) {
    const auto one = apps::parse_scene(head + "mesh b file sheet.obj " + clauses + "\n",
                                       models::beside({{"sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}}));
    INFO(apps::to_text(one, "s"));
    REQUIRE(one.file);
    CHECK(radiosity::faults(one.file->scene).empty());
    return one.file->scene.objects.size() - 1;
  };
  CHECK(sides("") == 1);
  CHECK(sides("two-sided") == 2);
  CHECK(sides("two-sided material m move 1 0 0") == 2);
  const std::pair<const char*, const char*> wrong[] = {
      {"mesh b two-sided material m\n", "has no 'file'; only a mesh from a file can be 'two-sided'"},
      {"box b from 0 0 0 to 1 1 1 two-sided material m\n", "two-sided"},
      {"mesh b file nowhere.obj\n", "s:3:13: error: the file 'nowhere.obj' is not there"},
      {"mesh b file x.txt\n", "s:3:13: error: the file 'x.txt' is of no known format"},
      {"mesh b file\n", "s:3:12: error: expected the name of a file"},
      {"mesh b file \"x\n", "s:3:13: error: expected the name of a file in double quotes"},
      {"mesh b file \"my room.obj\" inside\n", "has no 'inside' beside its file"},
      {"union u { \nmesh b file \"my room.obj\" \n} material m\n", "among operands"},
  };
  for (const auto& [text, sentence] : wrong) {
    CAPTURE(text, apps::to_text(parse(text), "s"));
    CHECK(apps::to_text(parse(text), "s").find(sentence) != std::string::npos);
  }
  CHECK_FALSE(apps::parse_scene(head + "mesh b file \"my room.obj\"\n").file);
}

TEST_CASE("cameras of a scene tell which of its meshes are seen from inside") {
  std::string box = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  box += "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";  // looks outwards
  const std::string head = "material m reflectance 0.5\nmaterial l reflectance 0 emission 1\nsphere s center 0 0 40 radius 1 material l\n";
  const auto inside = [&](const std::string& eye) {
    const auto result = apps::parse_scene(head + "mesh b file box.obj scale 4 move 10 0 0\ncamera c eye " + eye + " target 11 1 1\n",
                                          models::beside({{"box.obj", box}}));
    INFO(apps::to_text(result, "s"));
    REQUIRE(result.file);
    return result.file->scene.objects.back().placement.inside;
  };
  CHECK(inside("12 2 2"));
  CHECK_FALSE(inside("2 2 2"));
}

TEST_CASE("the program takes files of other programs wherever it takes scenes, and says what it changed") {
  const program::Place place;
  place.write("room.obj", models::room_obj + "o lamp\nusemtl lamp\nv 1 2.9 1\nv 2 2.9 1\nv 2 2.9 2\nv 1 2.9 2\nf 9 10 11 12\n");
  place.write("room.mtl", "newmtl wall\nKd 1\nnewmtl lamp\nKe 5\n");
  const program::Run info = place.run("info room.obj");
  INFO(info.err);
  CHECK(info.code == 0);
  CHECK(info.out.find("taken in:\n  1 material has no reflectance: 0.5 (--reflectance)\n  1 material reflects more than 0.99") !=
        std::string::npos);
  CHECK(info.out.find("7 polygons became 7 faces of 2 objects") != std::string::npos);
  const program::Run render = place.run("render room.obj --audit 0 --json - --quiet --epsilon 0.1 --threads 1");
  CHECK(render.code == 0);
  CHECK(render.out.find("\"taken_in\": [\n    \"1 material has no") != std::string::npos);
  CHECK(place.run("mesh room.obj").out.find("room") != std::string::npos);
  CHECK(place.run("factors room.obj --error 0.1 --two-sided").code == 0);
  CHECK(place.run("info - <room.obj").code == 0);
  const program::Run lamp = place.run("info room.obj --lamp wal=3");
  CHECK(lamp.code == 3);
  CHECK(lamp.err == "room.obj: error: --lamp wal: the file has no such material; it has wall or lamp; did you mean 'wall'?\n");
  CHECK(place.run("info room.obj --lamp wall=x").code == 2);
  place.write("a.scene", "material m reflectance 0.5\n");
  CHECK(place.run("info a.scene --lamp m").err.find("in a .scene the material says it") != std::string::npos);
  place.write("b.txt", models::room_obj);
  CHECK(place.run("info b.txt").err ==
        "halflight: b.txt is a polygon mesh (Wavefront OBJ), not a scene; give it a name that ends with the right "
        "letters (.obj, .ply or .off), and it is read as a scene\n");
}

TEST_CASE("an object for each of more than a hundred thousand things is no reason to refuse a file") {
  constexpr std::size_t things = 100'001;
  std::string obj;
  for (std::size_t i = 0; i < things; ++i) {
    const std::string x = std::to_string(2 * i);
    obj += "o t" + std::to_string(i) + "\nv " + x + " 0 0\nv " + x + ".5 0 0\nv " + x + " 0 1\nf -3 -2 -1\n";
  }
  apps::Model model = models::read("a.obj", obj);
  std::vector<std::string> faults;
  const auto file = apps::to_part(std::move(model), false, {}, faults);
  REQUIRE(file);
  CHECK(file->scene.objects.size() == things);
}
