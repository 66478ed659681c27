// SPDX-License-Identifier: MIT
// Colours that differ from polygon to polygon: each polygon reflects and emits the mean of its own.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/tone.hpp>

#include "apps/gltf_sample.hpp"
#include "apps/intake/texture.hpp"
#include "apps/models.hpp"
#include "apps/picture_file.hpp"
#include "catch.hpp"
#include "seed.hpp"

namespace {

using Rgb = std::array<int, 3>;

radiosity::Color linear(const Rgb& rgb) {
  radiosity::Color c(0.0);
  for (int k = 0; k < 3; ++k) { c[k] = radiosity::srgb_decode(rgb[static_cast<std::size_t>(k)] / 255.0); }
  return c;
}

struct Painter {
  std::mt19937 random;

  Rgb color() {
    Rgb rgb{};
    for (int& level : rgb) { level = static_cast<int>(random() % 256); }
    return rgb;
  }
  // A PNG of cells of 8 x 8 pixels, n each way, the first row first.
  std::string palette(std::uint32_t n, std::vector<Rgb>& cells) {
    cells.clear();
    for (std::uint32_t i = 0; i < n * n; ++i) { cells.push_back(color()); }
    radiosity::Picture picture(8 * n, 8 * n);
    for (std::uint32_t y = 0; y < 8 * n; ++y) {
      for (std::uint32_t x = 0; x < 8 * n; ++x) {
        const radiosity::Color c = linear(cells[y / 8 * n + x / 8]);
        picture.set(std::size_t{y} * 8 * n + x, c, c);
      }
    }
    return apps::to_png(picture);
  }
};

// Triangles beside each other, the three vertices of each its own.
std::string vertices(std::size_t triangles, const std::string& before, const std::vector<std::string>& behind) {
  std::string text;
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    text += before + std::to_string(i / 3 * 2 + (i % 3 == 1 ? 1 : 0)) + (i % 3 == 2 ? " 1" : " 0") + " 0" +
            (i < behind.size() ? " " + behind[i] : "") + "\n";
  }
  return text;
}

radiosity::Color reflectance(const apps::Model& model, std::size_t polygon) {
  const auto& given = model.materials[model.material[polygon]].reflectance;
  REQUIRE(given);
  return *given;
}

bool near(const radiosity::Color& a, const radiosity::Color& b, double tolerance) { return glm::length(a - b) <= tolerance; }

}  // namespace

TEST_CASE("of a palette each polygon has the colour of its cell, times the factor of its material") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  Painter painter{std::mt19937(seed)};
  const auto unit = [&] { return std::uniform_real_distribution(0.1, 0.9)(painter.random); };
  constexpr std::uint32_t n = 5, triangles = 30;
  std::vector<Rgb> cells;
  const std::string png = painter.palette(n, cells);
  std::vector<std::uint32_t> cell_of;
  std::string places, faces;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    cell_of.push_back(static_cast<std::uint32_t>(painter.random() % cells.size()));
    const double shift = static_cast<double>(painter.random() % 5) - 2.0;  // the picture repeats
    for (int k = 0; k < 3; ++k) {
      const double u = (cell_of[t] % n + unit()) / n + shift, v = (cell_of[t] / n + unit()) / n;  // v from the first row on
      places += "vt " + std::to_string(u) + " " + std::to_string(1.0 - v) + "\n";
    }
    const std::string first = std::to_string(3 * t + 1), second = std::to_string(3 * t + 2), third = std::to_string(3 * t + 3);
    faces += "f " + first + "/" + first + " " + second + "/" + second + " " + third + "/" + third + "\n";
  }
  const apps::Model model =
      models::read("a.obj", "mtllib a.mtl\n" + vertices(triangles, "v ", {}) + places + "usemtl paint\n" + faces,
                   {{"a.mtl", "newmtl paint\nKd 0.5 1 0.25\nKe 1 1 1\nmap_Kd p.png\nmap_Ke p.png\n"}, {"p.png", png}});
  REQUIRE(model.polygons() == triangles);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const radiosity::Color cell = linear(cells[cell_of[t]]);
    CHECK(near(reflectance(model, t), radiosity::Color(0.5, 1.0, 0.25) * cell, 0.002));
    CHECK(near(model.materials[model.material[t]].emission, std::numbers::pi * cell, 0.006));
    CHECK(model.materials[model.material[t]].name == "paint");
  }
  CHECK(models::noted(model.notes, "each polygon has the mean colour of its part"));
}

TEST_CASE("a picture that varies within each polygon more than between them counts with its mean") {
  Painter painter{std::mt19937(5)};
  std::vector<Rgb> cells;
  const std::string png = painter.palette(8, cells);
  radiosity::Color mean(0.0);
  for (const Rgb& cell : cells) { mean += linear(cell) / static_cast<double>(cells.size()); }
  const apps::Model model = models::read(
      "a.obj", "mtllib a.mtl\n" + vertices(2, "v ", {}) + "vt 0 0\nvt 3 0\nvt 0 3\nvt 3 3\nusemtl paint\nf 1/1 2/2 3/3\nf 4/2 5/4 6/3\n",
      {{"a.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd p.png\n"}, {"p.png", png}});
  CHECK(near(reflectance(model, 0), mean, 1e-6));
  CHECK(model.material[0] == model.material[1]);
}

TEST_CASE("of a picture that glows in few places what is dark does not shine, and no light is lost") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto whole = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int run = 0; run < 10; ++run) {
    // 64 x 64 pixels: lights of 2 x 2 pixels on a black that is up to 3 of 255 levels, as of a JPEG; a net of squares covers it once.
    const std::uint32_t n = 4 + whole(5), lights = 1 + whole(3);
    radiosity::Picture picture(64, 64);
    for (std::size_t i = 0; i < 4096; ++i) {
      const radiosity::Color black = linear({static_cast<int>(whole(4)), static_cast<int>(whole(4)), static_cast<int>(whole(4))});
      picture.set(i, black, black);
    }
    std::set<std::uint32_t> lit;  // the squares that have a light
    for (std::uint32_t k = 0; k < lights; ++k) {
      const std::uint32_t x = whole(63), y = whole(63);
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t px = x + i % 2, py = y + i / 2;
        picture.set(std::size_t{py} * 64 + px, radiosity::Color(1.0), radiosity::Color(1.0));
        // A square has the pixels that it touches.
        for (std::uint32_t row = py * n / 64; row <= ((py + 1) * n - 1) / 64; ++row) {
          for (std::uint32_t column = px * n / 64; column <= ((px + 1) * n - 1) / 64; ++column) { lit.insert(row * n + column); }
        }
      }
    }
    std::string obj = "mtllib a.mtl\nusemtl device\n";
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t k = 0; k <= n; ++k) {
        const double u = static_cast<double>(k) / n, v = static_cast<double>(i) / n;
        obj += "v " + std::to_string(u) + " " + std::to_string(v) + " 0\nvt " + std::to_string(u) + " " + std::to_string(1.0 - v) + "\n";
      }
    }
    const auto corner = [&](std::uint32_t i, std::uint32_t k) {
      const std::string index = std::to_string(i * (n + 1) + k + 1);
      return " " + index + "/" + index;
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t k = 0; k < n; ++k) {
        obj += "f" + corner(i, k) + corner(i, k + 1) + corner(i + 1, k + 1) + corner(i + 1, k) + "\n";
      }
    }
    const apps::Model model =
        models::read("a.obj", obj, {{"a.mtl", "newmtl device\nKd .5 .5 .5\nKe 1 1 1\nmap_Ke p.png\n"}, {"p.png", apps::to_png(picture)}});
    REQUIRE(model.polygons() == n * n);
    double light = 0.0, brightest = 0.0;
    const auto read = apps::intake::Picture::read(apps::to_png(picture));
    for (std::uint32_t p = 0; p < n * n; ++p) {
      const double emission = model.materials[model.material[p]].emission.x / std::numbers::pi;
      if (lit.count(p) == 0) { CHECK(emission == 0.0); }
      light += emission / (n * n);
      brightest = std::max(brightest, emission);
    }
    REQUIRE(read);
    // All but the noise on black, whose mean is below half of its largest, and the rounding of colours to 255 levels.
    const double rounding = static_cast<double>(lit.size()) * 0.6 / 255.0 * 2.4 * std::pow(brightest, 1.4 / 2.4) / (n * n);
    CHECK(std::abs(light - read->mean().x) < 0.5 * linear({3, 3, 3}).x + rounding);
  }
}

TEST_CASE("colours of vertices and faces in OBJ, PLY and OFF are the reflectance") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  Painter painter{std::mt19937(seed)};
  constexpr std::size_t triangles = 12;
  std::vector<Rgb> colors;
  std::vector<std::string> bytes, shares;
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    const Rgb c = colors.emplace_back(painter.color());
    bytes.push_back(std::to_string(c[0]) + " " + std::to_string(c[1]) + " " + std::to_string(c[2]));
    shares.push_back(std::to_string(c[0] / 255.0) + " " + std::to_string(c[1] / 255.0) + " " + std::to_string(c[2] / 255.0));
  }
  std::string obj_faces, list;
  for (std::size_t t = 0; t < triangles; ++t) {
    obj_faces += "f " + std::to_string(3 * t + 1) + " " + std::to_string(3 * t + 2) + " " + std::to_string(3 * t + 3) + "\n";
    list += "3 " + std::to_string(3 * t) + " " + std::to_string(3 * t + 1) + " " + std::to_string(3 * t + 2) + "\n";
  }
  const std::string count = std::to_string(3 * triangles) + " " + std::to_string(triangles);
  const auto ply = [&](const std::string& type, const std::vector<std::string>& of) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(3 * triangles) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty " + type + " red\nproperty " + type + " green\nproperty " +
           type + " blue\nelement face " + std::to_string(triangles) + "\nproperty list uchar int vertex_indices\nend_header\n" +
           vertices(triangles, "", of) + list;
  };
  for (const apps::Model& model : {models::read("a.obj", vertices(triangles, "v ", shares) + obj_faces),
                                   models::read("a.obj", vertices(triangles, "v ", bytes) + obj_faces),
                                   models::read("a.ply", ply("uchar", bytes)), models::read("a.ply", ply("float", shares)),
                                   models::read("a.off", "COFF\n" + count + " 0\n" + vertices(triangles, "", bytes) + list)}) {
    REQUIRE(model.polygons() == triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      const radiosity::Color mean = (linear(colors[3 * t]) + linear(colors[3 * t + 1]) + linear(colors[3 * t + 2])) / 3.0;
      CHECK(near(reflectance(model, t), mean, 0.01));  // of 255 levels in sRGB
    }
  }
  // The colour of a face counts more than those of its vertices; a file whose colours are no numbers is read all the same.
  std::string colored;
  for (std::size_t t = 0; t < triangles; ++t) {
    colored += "3 " + std::to_string(3 * t) + " " + std::to_string(3 * t + 1) + " " + std::to_string(3 * t + 2) + " " + shares[t] + "\n";
  }
  const apps::Model faces = models::read("a.off", "OFF\n" + count + " 0\n" + vertices(triangles, "", {}) + colored);
  for (std::size_t t = 0; t < triangles; ++t) { CHECK(near(reflectance(faces, t), linear(colors[t]), 0.01)); }
  const apps::Model plain = models::read("a.ply", ply("float", std::vector<std::string>(3 * triangles, "nan nan nan")));
  CHECK_FALSE(plain.materials[plain.material[0]].reflectance);
}

TEST_CASE("a white face among coloured ones is white, in a file that has nothing but white the reflectance stays open") {
  const std::string head = "OFF\n6 2 0\n" + vertices(2, "", {}), first = "3 0 1 2 255 255 255\n";
  const apps::Model mixed = models::read("a.off", head + first + "3 3 4 5 200 200 200\n");
  CHECK(near(reflectance(mixed, 0), radiosity::Color(1.0), 1e-12));
  CHECK(near(reflectance(mixed, 1), linear({200, 200, 200}), 1e-6));
  const apps::Model white = models::read("a.off", head + first + "3 3 4 5 255 255 255\n");
  CHECK_FALSE(white.materials[white.material[0]].reflectance);
  const apps::Model partly = models::read("a.off", head + "3 0 1 2 10 20 30\n3 3 4 5\n");
  CHECK_FALSE(partly.materials[partly.material[1]].reflectance);
}

TEST_CASE("glTF: colours of vertices and places in a picture, under a transform of the texture, give each triangle its own") {
  Painter painter{std::mt19937(11)};
  std::vector<Rgb> cells;
  const std::string png = painter.palette(2, cells);
  gltf_sample::Sample sample;
  // Vertices 0 and 2 are common to both triangles, so is their place: in the third cell, moved from the first by the transform.
  const std::size_t first = sample.binary.size();
  for (const float x : {0.1F, 0.1F, 0.2F, 0.1F, 0.15F, 0.2F, 0.1F, 0.2F}) { gltf_sample::put(sample.binary, x); }
  for (const int level : {255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 255}) {
    gltf_sample::put(sample.binary, static_cast<std::uint8_t>(level));
  }
  sample.views.pop_back();
  sample.views += ", {\"buffer\": 0, \"byteOffset\": " + std::to_string(first) +
                  ", \"byteLength\": 32}, {\"buffer\": 0, \"byteOffset\": " + std::to_string(first + 32) + ", \"byteLength\": 16}]";
  sample.accessors.pop_back();
  sample.accessors +=
      ", {\"bufferView\": 2, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC2\"}, {\"bufferView\": 3, \"componentType\": 5121, "
      "\"normalized\": true, \"count\": 4, \"type\": \"VEC4\"}]";
  sample.primitive = "{\"attributes\": {\"POSITION\": 0, \"TEXCOORD_1\": 2, \"COLOR_0\": 3}, \"indices\": 1, \"material\": 0}";
  sample.more =
      ", \"images\": [{\"uri\": \"p.png\"}], \"textures\": [{\"source\": 0}], \"materials\": [{\"pbrMetallicRoughness\": "
      "{\"baseColorTexture\": {\"index\": 0, \"texCoord\": 1, \"extensions\": {\"KHR_texture_transform\": {\"offset\": [0, 0.5]}}}}}]";
  const apps::Model model = models::read("a.gltf", sample.embedded(), {{"p.png", png}});
  REQUIRE(model.polygons() == 2);
  const radiosity::Color cell = linear(cells[2]);
  CHECK(near(reflectance(model, 0), cell * radiosity::Color(2.0 / 3.0, 1.0, 1.0), 0.01));
  CHECK(near(reflectance(model, 1), cell * radiosity::Color(1.0, 1.0, 2.0 / 3.0), 0.01));
}

TEST_CASE("of more than 256 colours those within a sixteenth become one") {
  Painter painter{std::mt19937(3)};
  constexpr std::size_t triangles = 6000;
  std::vector<Rgb> colors;
  std::string faces;
  for (std::size_t t = 0; t < triangles; ++t) {
    const Rgb c = colors.emplace_back(painter.color());
    faces += "3 " + std::to_string(3 * t) + " " + std::to_string(3 * t + 1) + " " + std::to_string(3 * t + 2) + " " + std::to_string(c[0]) +
             " " + std::to_string(c[1]) + " " + std::to_string(c[2]) + "\n";
  }
  const apps::Model model = models::read(
      "a.off", "OFF\n" + std::to_string(3 * triangles) + " " + std::to_string(triangles) + " 0\n" + vertices(triangles, "", {}) + faces);
  const std::set<std::uint32_t> used(model.material.begin(), model.material.end());
  CHECK(used.size() > 256);
  CHECK(used.size() <= 17 * 17 * 17);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) {
      const double level = radiosity::srgb_encode(reflectance(model, t)[k]);
      CHECK(std::abs(level - colors[t][static_cast<std::size_t>(k)] / 255.0) <= 0.5 / 16.0 + 1e-9);
    }
  }
}
