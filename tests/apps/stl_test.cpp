// SPDX-License-Identifier: MIT

// STL files: text and binary say the same, equal positions are one corner, and what is damaged is told with its place.

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/bytes.hpp"
#include "apps/file_kind.hpp"
#include "apps/intake/model.hpp"
#include "catch.hpp"
#include "models.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

using Triangle = std::array<glm::vec3, 3>;

std::vector<Triangle> cube() {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float at : {0.0F, 1.0F}) {
      const auto corner = [&](float u, float v) {
        glm::vec3 p{0.0F};
        p[axis] = at;
        p[(axis + 1) % 3] = at > 0.0F ? u : v;
        p[(axis + 2) % 3] = at > 0.0F ? v : u;
        return p;
      };
      triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  }
  return triangles;
}

std::string as_text(const std::vector<Triangle>& triangles, const std::string& end = "\n") {
  std::string text = "solid my cube" + end;
  const auto numbers = [](const glm::vec3& p) { return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z); };
  for (const Triangle& t : triangles) {
    text += "  facet normal 0 0 0" + end + "    outer loop" + end;
    for (const glm::vec3& p : t) { text += "      vertex " + numbers(p) + end; }
    text += "    endloop" + end + "  endfacet" + end;
  }
  return text + "endsolid my cube" + end;
}

std::string as_binary(const std::vector<Triangle>& triangles, std::string header = "made by a program") {
  header.resize(80);
  apps::put(header, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    apps::put(header, glm::vec3{0.0F});
    for (const glm::vec3& p : t) { apps::put(header, p); }
    apps::put(header, std::uint16_t{7});
  }
  return header;
}

}  // namespace

TEST_CASE("STL: text and binary say the same, whatever the header, line ends and case, and a solid is one") {
  const apps::Model text = models::read("a.stl", as_text(cube()));
  CHECK(text.positions.size() == 8);
  CHECK(text.polygons() == 12);
  CHECK(text.groups == std::vector<std::string>{"my cube"});
  std::string shouted = as_text(cube());
  for (char& c : shouted) { c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
  for (const std::string& bytes :
       {as_text(cube(), "\r\n"), as_text(cube(), "\n\t\n"), shouted, as_binary(cube()), as_binary(cube(), "solid facet, but binary"),
        as_binary(cube()) + "more", as_binary(cube(), "solid, but binary") + "more", "\xef\xbb\xbf" + as_text(cube())}) {
    const apps::Model same = models::read("a.STL", bytes);
    CHECK(same.positions == text.positions);
    CHECK(same.corners == text.corners);
    CHECK(same.first_corner == text.first_corner);
  }
  for (const std::string& bytes : {as_text(cube()), as_binary(cube())}) {
    const apps::SceneFile file = models::scene("a.stl", bytes);
    REQUIRE(file.scene.objects.size() == 3);  // with the studio and its lamp
    CHECK(file.scene.objects[1].shape->solid());
    CHECK(apps::model_format("-", bytes) == apps::model_format("a.stl", ""));
  }
}

TEST_CASE("STL: several solids are groups, and facets have as many corners as they say") {
  const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 1 -0 endloop endfacet\n";
  const apps::Model two = models::read("a.stl", "solid a\n" + facet + "endsolid a\nsolid b c\n" + facet + facet + "endsolid b c\n");
  CHECK(two.groups == std::vector<std::string>{"a", "b c"});
  CHECK(two.group == std::vector<std::uint32_t>{0, 1, 1});
  CHECK(two.positions.size() == 4);
  CHECK(two.first_corner == std::vector<std::uint32_t>{0, 4, 8, 12});
  CHECK(two.line == std::vector<std::uint32_t>{2, 5, 6});
  CHECK(models::read("a.stl", "solid\n" + facet + "endsolid\n" + facet).polygons() == 2);
}

TEST_CASE("STL: what is wrong is told with its place") {
  const std::string start = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
  const std::pair<std::string, const char*> cases[] = {
      {"solid a\nendsolid a\n", ":2:11: error: the file has no facets; the name of a solid ends with its line"},
      {"solid a\nface normal 0 0 1\n", ":2:1: error: expected solid, facet or endsolid, found 'face'"},
      {"solid a\nfacet normal 0 0\n", ":2:17: error: expected a number, found the end of the file"},
      {"solid a\nfacet normal 0 0 1 loop\n", ":2:20: error: expected outer, found 'loop'"},
      {start + "vertex 1 x 0\n", ":5:10: error: expected a coordinate, a finite number, found 'x'"},
      {start + "vertex 1 inf 0\n", ":5:10: error: expected a coordinate, a finite number, found 'inf'"},
      {start + "vertex 1 0 0\nendloop\n", ":6:1: error: expected vertex, found 'endloop'"},
      {start + "vertex 1 0 0\nvertex 0 1 0\nendfacet\n", ":7:1: error: expected vertex or endloop, found 'endfacet'"},
      {"", ":1:1: error: expected an STL file: text that begins with 'solid', or 84 bytes and then 50 for each triangle"},
      {as_binary({}), ":byte 81: error: the file has no triangles"},
      {"facet" + std::string(90, ' '),
       ":1:1: error: expected an STL file: text that begins with 'solid', or 84 bytes and then 50 for each triangle"},
      {as_binary(cube(), "solid").substr(0, 600), ":byte 601: error: the file ends within triangle 11 of the 12 that its header promises"},
  };
  for (const auto& [bytes, expected] : cases) { CHECK(models::error("a.stl", bytes) == expected); }
  std::vector<Triangle> broken = cube();
  broken[4][1].y = std::numeric_limits<float>::infinity();
  CHECK(models::error("a.stl", as_binary(broken)) == ":byte 297: error: a coordinate of triangle 5 is not a finite number");
}

TEST_CASE("STL: of a binary file all lengths are told or read, and no number of triangles takes memory") {
  std::string bytes = as_binary(cube());
  for (std::size_t size = 0; size <= bytes.size() + 60; ++size) {
    std::string cut = bytes;
    cut.resize(size);
    CHECK(models::result("a.stl", cut).model.has_value() == (size >= bytes.size()));
  }
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  CHECK(models::error("a.stl", bytes) == ":byte 685: error: the file ends within triangle 13 of the 4294967295 that its header promises");
}

TEST_CASE("STL: damaged files give a model or an error, and end") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 400; ++run) {
    std::string bytes = run % 2 == 0 ? as_text(cube()) : as_binary(cube());
    for (auto k = random() % 4; k > 0; --k) { bytes[random() % bytes.size()] = static_cast<char>(random() % 256); }
    if (random() % 3 == 0) { bytes.resize(random() % bytes.size()); }
    static_cast<void>(models::result("a.stl", bytes));
  }
}

TEST_CASE("STL: the program renders and converts it, and says what to do where another file is wanted") {
  const program::Place place;
  place.write("a.stl", as_binary(cube()));
  place.write("wrong.scene", as_text(cube()));
  CHECK(place.run("mesh a.stl -o a.obj").code == 0);
  CHECK(place.read("a.obj").find("\no mesh\n") != std::string::npos);
  CHECK(place.run("render a.stl -o a.png --size 32x24 --audit 0 --quiet").code == 0);
  CHECK(apps::guess_kind("solid\nmaterial m reflectance 0.5\n").kind != apps::FileKind::stl);
  CHECK(place.run("info wrong.scene").err ==
        "halflight: wrong.scene is a polygon mesh (STL), not a scene; give it a name that ends with .stl, and it is read as a scene\n");
  CHECK(place.run("check a.stl").err ==
        "halflight: a.stl is a polygon mesh (STL), not an OBJ file; `halflight mesh a.stl -o OUT.obj` converts it\n");
}
