// SPDX-License-Identifier: MIT
// What a scene file says is what the scene holds: every statement and every clause.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>

#include <raycast/spans.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/scene_file.hpp"
#include "scene_texts.hpp"
#include "seed.hpp"

namespace {

apps::SceneFile parsed(const std::string& text) {
  apps::SceneResult result = apps::parse_scene(text);
  INFO(apps::to_text(result, "test"));
  REQUIRE(result.file);
  return std::move(*result.file);
}

using scene_texts::grey;

void require_near(const glm::dvec3& a, const glm::dvec3& b) {
  for (int i = 0; i < 3; ++i) { CHECK(a[i] == test::Approx(b[i]).margin(1e-15)); }
}

}  // namespace

TEST_CASE("a material has one number or three, and black defaults") {
  const auto file = parsed(
      "material a reflectance 0.25\n"
      "material b emission 1 2 3 reflectance 0.1 .2 3e-1 # comment\n"
      "material c {\n  # nothing\n  reflectance +1\n\n  emission 17\n}\n"
      "material d\n"
      "sphere s center 0 0 0 radius 1 material a\n");
  const auto& m = file.scene.materials;
  REQUIRE(m.size() == 4);
  CHECK(m[0].reflectance == glm::dvec3(0.25));
  CHECK(m[0].emission == glm::dvec3(0.0));
  CHECK(m[1].reflectance == glm::dvec3(0.1, 0.2, 0.3));
  CHECK(m[1].emission == glm::dvec3(1.0, 2.0, 3.0));
  CHECK(m[2].reflectance == glm::dvec3(1.0));
  CHECK(m[2].emission == glm::dvec3(17.0));
  CHECK(m[3].reflectance == glm::dvec3(0.0));
}

TEST_CASE("every kind of object is made with its bounds, and says where it came from") {
  const auto file = parsed(grey +
                           "box b from 1 1 1 to 0 0 0 material grey\n"
                           "sphere s center 1 2 3 radius 0.5 material grey inside\n"
                           "cylinder c base 0 0 0 axis 0 0 2 radius 1 material grey\n"
                           "polygon p material grey { vertex 0 0 0 vertex 1 0 0\n vertex 0 1 0 }\n"
                           "mesh m material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n vertex 0 0 1\n"
                           " face 0 2 1\n face 0 1 3\n face 0 3 2\n face 1 2 3\n}\n");
  const auto& objects = file.scene.objects;
  REQUIRE(objects.size() == 5);
  CHECK(objects[0].shape->bounds().hi == glm::dvec3(1.0));
  require_near(objects[1].shape->bounds().lo, {0.5, 1.5, 2.5});
  CHECK(objects[1].placement.inside);
  CHECK(objects[2].shape->sheet_count() == 3);
  CHECK_FALSE(objects[3].shape->solid());
  CHECK(objects[4].shape->solid());
  CHECK(objects[4].shape->sheet_count() == 4);
  CHECK(file.origins[2].kind == "cylinder");
  CHECK(file.origins[2].place.line == 4);
  CHECK(file.origins[2].place.column == 10);
}

TEST_CASE("sheets have materials of their own, by name or by number, given before or after the object") {
  const auto file = parsed(
      "box b from 0 0 0 to 1 1 1 inside material grey { sheet x0 material red\n sheet 5 material red }\n"
      "cylinder c base 0 0 0 axis 0 0 1 radius 1 sheet side material red sheet bottom material grey sheet top material grey\n" +
      grey + "material red reflectance 0.6 0 0\n");
  CHECK(file.scene.objects[0].material == std::vector<std::uint32_t>{1, 0, 0, 0, 0, 1});
  const auto& cylinder = file.scene.objects[1];
  for (std::uint32_t i = 0; i < 3; ++i) { CHECK(cylinder.material[i] == (cylinder.shape->sheet_name(i) == "side" ? 1U : 0U)); }
}

TEST_CASE("leaves of unions, intersections and differences keep their materials, or take that of what is around them") {
  const auto file = parsed(grey +
                           "material red reflectance 0.6 0 0\n"
                           "difference wall material grey move 0 0 5 {\n"
                           "  box slab from 0 0 0 to 4 1 3 { sheet y1 material red\n material grey }\n"
                           "  union holes material red {\n"
                           "    box window from 1 -1 1 to 2 2 2\n"
                           "    cylinder eye base 3 -1 2 axis 0 3 0 radius 0.4 material grey\n"
                           "    move 0.5 0 0\n"
                           "  }\n"
                           "}\n");
  REQUIRE(file.scene.objects.size() == 1);
  const auto& wall = file.scene.objects[0];
  CHECK(file.origins[0].kind == "difference");
  CHECK(wall.placement.translation == glm::dvec3(0.0, 0.0, 5.0));
  CHECK(wall.shape->bounds().hi == glm::dvec3(4.0, 1.0, 3.0));
  std::string sheets;
  for (std::uint32_t i = 0; i < wall.shape->sheet_count(); ++i) {
    sheets += std::string(wall.shape->sheet_name(i)) + (wall.material[i] == 0 ? " grey, " : " red, ");
  }
  CHECK(sheets ==
        "slab.x0 grey, slab.x1 grey, slab.y0 grey, slab.y1 red, slab.z0 grey, slab.z1 grey, "
        "holes.window.x0 red, holes.window.x1 red, holes.window.y0 red, holes.window.y1 red, holes.window.z0 red, holes.window.z1 red, "
        "holes.eye.side grey, holes.eye.bottom grey, holes.eye.top grey, ");
  // The placement of the union of holes stays within the tree: the window begins at x = 1.5.
  const auto left = wall.shape->project(6, {0.0, 0.0, 0.0});
  CHECK(left.position.x == 1.5);
  CHECK(left.normal.x == 1.0);  // into the hole
}

TEST_CASE("a use among operands is the union of what is in its group, placed, with the group's materials") {
  const auto file = parsed(grey +
                           "material red reflectance 0.6 0 0\n"
                           "define frame {\n"
                           "  box wide from 0 0 0 to 2 1 1 material red\n"
                           "  box high from 0 0 0 to 1 1 3 material grey\n"
                           "}\n"
                           "define two {\n"
                           "  use frame as a\n"
                           "  difference b { box all from 4 0 0 to 5 1 1 material red\n use frame as c scale 0.5 move 4 0 0\n }\n"
                           "}\n"
                           "difference wall {\n"
                           "  box slab from -1 -1 -1 to 9 2 5 material grey\n"
                           "  use two as holes move 0 0 1\n"
                           "}\n"
                           "use frame as alone\n");
  REQUIRE(file.scene.objects.size() == 3);  // wall, alone.wide, alone.high
  const auto& wall = file.scene.objects[0];
  std::string leaves;
  for (std::uint32_t i = 0; i < wall.shape->sheet_count(); i += 6) {
    leaves += std::string(wall.shape->sheet_name(i)) + (wall.material[i] == 0 ? " grey, " : " red, ");
  }
  CHECK(leaves ==
        "slab.x0 grey, holes.a.wide.x0 red, holes.a.high.x0 grey, holes.b.all.x0 red, holes.b.c.wide.x0 red, holes.b.c.high.x0 grey, ");
  // Along z: at x = .5 the hole is the high box of the frame, from 1 to 4. At x = 4.2 the small frame takes all of the hole away.
  const auto at = [&](double x) {
    raycast::Spans spans;
    wall.shape->spans({{x, 0.25, 0.0}, {0.0, 0.0, 1.0}}, spans);
    std::vector<double> crossings;
    for (const raycast::Span& span : spans) {
      crossings.push_back(span.in.t);
      crossings.push_back(span.out.t);
    }
    return crossings;
  };
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) { CHECK(a[i] == test::Approx(b[i]).margin(1e-9)); }
  };
  near(at(0.5), {-1, 1, 4, 5});
  near(at(4.2), {-1, 5});
  near(at(4.8), {-1, 1.5, 2, 5});  // the small frame is half as high here
}

TEST_CASE("placement clauses act in the order of the file, about the origin of the scene") {
  const auto file = parsed(grey +
                           "box a from 0 0 0 to 1 1 1 material grey move 2 0 0 rotate 0 0 1 90 scale 1 2 3\n"
                           "box b from 0 0 0 to 1 1 1 material grey scale 2 move 1 1 1\n"
                           "box c from 0 0 0 to 1 1 1 material grey rotate 1 1 1 120\n"
                           "box d from 0 0 0 to 1 2 3 material grey scale -1 1 1\n");
  const auto at = [&](std::size_t i, const glm::dvec3& p) {
    const auto& placement = file.scene.objects[i].placement;
    return placement.linear * p + placement.translation;
  };
  // (1,0,0) moved to (3,0,0), turned to (0,3,0), scaled to (0,6,0). Quarter turns are exact.
  CHECK(at(0, {1.0, 0.0, 0.0}) == glm::dvec3(0.0, 6.0, 0.0));
  CHECK(at(1, {1.0, 0.0, 0.0}) == glm::dvec3(3.0, 1.0, 1.0));
  // A third of a turn about the diagonal sends x to y to z.
  require_near(at(2, {1.0, 0.0, 0.0}), {0.0, 1.0, 0.0});
  require_near(at(2, {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0});
  CHECK(at(3, {1.0, 2.0, 3.0}) == glm::dvec3(-1.0, 2.0, 3.0));
}

TEST_CASE("a group is placed as often as it is used, in groups too, and shares its shapes") {
  const auto file = parsed(grey +
                           "use chair as front move 0 -1 0\n"
                           "define row {\n  use chair as left\n  use chair as right move 2 0 0\n}\n"
                           "define chair {\n  box seat from 0 0 0 to 1 1 1 material grey {\n    inside\n  }\n"
                           "  box back from 0 0 1 to 1 0.5 2 material grey scale 2\n}\n"
                           "use row as back rotate 0 0 1 90 move 0 0 5\n");
  const auto& objects = file.scene.objects;
  REQUIRE(objects.size() == 6);
  CHECK(objects[0].name == "front.seat");
  CHECK(objects[2].name == "back.left.seat");
  CHECK(objects[5].name == "back.right.back");
  CHECK(objects[0].shape == objects[4].shape);
  CHECK(objects[4].placement.inside);
  // Own placement first (scale 2), then the group's (move 2 0 0), then the row's (quarter turn, move 0 0 5).
  const auto& last = objects[5].placement;
  CHECK(last.linear * glm::dvec3(1.0, 0.5, 2.0) + last.translation == glm::dvec3(-1.0, 4.0, 9.0));
}

TEST_CASE("a camera has its clauses and sensible defaults") {
  const auto file = parsed(grey +
                           "sphere s center 0 0 0 radius 1 material grey\n"
                           "camera a target 1 2 3 eye 1 0 3\n"
                           "camera b eye 0 0 9 look 0 0 -2\n"
                           "camera c eye 0 0 9 look 0 0 -2 up 1 0 0 fov 39.3 size 640 480\n");
  REQUIRE(file.cameras.size() == 3);
  CHECK(file.cameras[0].forward == glm::dvec3(0.0, 2.0, 0.0));
  CHECK(file.cameras[0].up == glm::dvec3(0.0, 0.0, 1.0));
  CHECK(file.cameras[0].field_of_view == 50.0);
  CHECK_FALSE(file.cameras[0].size);
  CHECK(file.cameras[1].up == glm::dvec3(0.0, 1.0, 0.0));  // z is the view, so y is up
  CHECK(file.cameras[2].name == "c");
  CHECK(file.cameras[2].field_of_view == 39.3);
  CHECK(file.cameras[2].size->width == 640);
}

TEST_CASE("line ends of every system, byte order mark, tabs, UTF-8 names and no last line end") {
  const std::string unix_text =
      "# Würfel\nmaterial gr\xc3\xbcn\treflectance 0.5\nbox w\xc3\xbcrfel from 0 0 0 to 1 1 1 material gr\xc3\xbcn";
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xef\xbb\xbf";
    for (const char c : unix_text) { text += c == '\n' ? std::string(end) : std::string(1, c); }
    const auto file = parsed(text);
    CHECK(file.scene.objects[0].name == "w\xc3\xbcrfel");
    CHECK(file.origins[0].place.line == 3);
  }
}

TEST_CASE("the limit counts objects: uses of groups, however deep, count none") {
  const auto scene = [](std::size_t objects) {
    std::string text = "material m reflectance 0.5\ndefine a {\nbox b from 0 0 0 to 1 1 1 material m\n}\ndefine c {\nuse a as d\n}\n";
    for (std::size_t i = 0; i < objects; ++i) { text += "use c as u" + std::to_string(i) + " move 0 0 " + std::to_string(2 * i) + "\n"; }
    return apps::parse_scene(text);
  };
  const apps::SceneResult most = scene(apps::max_objects);
  INFO(apps::to_text(most, "most"));
  REQUIRE(most.file);
  CHECK(most.file->scene.objects.size() == apps::max_objects);
  const apps::SceneResult more = scene(apps::max_objects + 1);
  REQUIRE(more.errors.size() == 1);
  CHECK(more.errors[0].sentence == "the scene grows beyond 100000 objects here");
}

TEST_CASE("all scenes of examples/scenes are sound") {
  for (const char* const name : {"cornell", "room", "furnace", "white_sphere", "two_plates", "emitting_wall"}) {
    std::string fault;
    const auto text = apps::read_text(HALFLIGHT_SCENES + ("/" + std::string(name)) + ".scene", fault);
    INFO(name << " " << fault);
    REQUIRE(text);
    const auto file = parsed(*text);
    CHECK(radiosity::faults(file.scene).empty());
  }
}

TEST_CASE("the example in the README of the scenes is sound") {
  std::string fault;
  const std::string readme = apps::read_text(std::string(HALFLIGHT_SCENES) + "/README.md", fault).value();
  const std::size_t begin = readme.find("    material white");
  const std::size_t end = readme.find("## Grammar");
  REQUIRE(begin < end);
  const auto file = parsed(readme.substr(begin, end - begin));
  REQUIRE(file.scene.objects.size() == 15);
  CHECK(file.scene.objects[13].name == "second.back");
  CHECK(file.scene.objects[14].name == "bench");
}

// Rounded to a part in 10^5 of the way to the target, so that directions differ by at most twice that, and a little for what lies askew.
TEST_CASE("the text of a camera reads back as the same view, in few digits, at any place and size") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  const auto parted = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(glm::normalize(a) - glm::normalize(b)); };
  for (int run = 0; run < 500; ++run) {
    const double size = std::pow(10.0, 8.0 * unit(random)), place = size * std::pow(10.0, 3.0 * unit(random));
    radiosity::Camera camera;
    camera.eye = run % 10 == 0 ? glm::dvec3(0.0) : place * point();
    camera.forward = size * point();
    if (run % 2 == 0) { camera.up = size * point(); }
    camera.field_of_view = 90.0 + 80.0 * unit(random);
    const std::string text = apps::camera_text(camera);
    std::string fault;
    const auto read = apps::parse_camera(text, fault);
    CAPTURE(text, fault, size, place);
    REQUIRE(read);
    CHECK(glm::length(read->eye - camera.eye) <= 1e-5 * std::min(glm::length(camera.eye), glm::length(camera.forward)));
    CHECK(parted(read->forward, camera.forward) < 4e-5);
    CHECK(parted(read->up, camera.up) < 2e-5);
    CHECK(read->field_of_view == test::Approx(camera.field_of_view).epsilon(1e-5));
    if (place < 10.0 * size) { CHECK(text.size() < 150); }
  }
}
