// SPDX-License-Identifier: MIT
// Draco: one mesh in all encodings, what is damaged, and glTF files with compressed meshes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "apps/intake/draco.hpp"
#include "gltf_sample.hpp"
#include "models.hpp"
#include "seed.hpp"
#include "torus.hpp"

namespace draco = apps::intake::draco;
using gltf_sample::put;
using gltf_sample::Sample;
using models::read;

namespace {

// A torus whose texture coordinates are (i / n, j / n), so that each corner tells its place in the grid. Positions have 8 bits
// (tests/data/README.md).
struct File {
  std::string name;
  int n;
};
const std::vector<File> files{
    {"torus_24_level_10", 24},  // Edgebreaker with symbols by valence, constrained multi-parallelograms
    {"torus_9_level_10", 9},    // Edgebreaker, traversal by degree
    {"torus_9_level_7", 9},     // Edgebreaker, seams, texture coordinates from positions
    {"torus_9_level_4", 9},     // Edgebreaker, one vertex for each pair of position and texture coordinates, parallelograms
    {"torus_9_level_0", 9},     // sequential
};

std::string bytes_of(const File& file) {
  std::ifstream in(HALFLIGHT_TEST_DATA "/draco/" + file.name + ".drc", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

draco::Mesh mesh_of(const File& file) {
  std::string fault;
  auto mesh = draco::read_mesh(bytes_of(file), fault);
  CAPTURE(file.name, fault);
  REQUIRE(mesh);
  return *mesh;
}

// A stream without any compression: sequential, the numbers as they are in memory.
struct RawAttribute {
  int type, data_type, components, normalized;
  std::string bytes;
};
std::string raw_stream(std::size_t points, const std::vector<std::uint8_t>& corners, const std::vector<RawAttribute>& attributes) {
  std::string out("DRACO\2\2\1\0\0\0", 11);
  for (const std::size_t n : {corners.size() / 3, points, std::size_t{1}}) { out += static_cast<char>(n); }
  out.append(corners.begin(), corners.end());
  out += '\1';
  out += static_cast<char>(attributes.size());
  char id = 0;
  for (const RawAttribute& a : attributes) {
    for (const int n : {a.type, a.data_type, a.components, a.normalized, int{id++}}) { out += static_cast<char>(n); }
  }
  out.append(attributes.size(), '\0');
  for (const RawAttribute& a : attributes) { out += a.bytes; }
  return out;
}

// A glTF file whose only primitive has this stream. `color`: the type of numbers of COLOR_0, with three components; 0: no colours.
Sample packed(const std::string& stream, std::size_t points, std::size_t corners, int color = 0) {
  Sample sample;
  sample.binary = stream;
  sample.views = "[{\"buffer\": 0, \"byteLength\": " + std::to_string(stream.size()) + "}]";
  const auto accessor = [](int type, std::size_t count, const std::string& kind) {
    return "{\"componentType\": " + std::to_string(type) + ", \"count\": " + std::to_string(count) + ", \"type\": \"" + kind + "\"" +
           (type == 5121 ? ", \"normalized\": true}" : "}");
  };
  sample.accessors = "[" + accessor(5126, points, "VEC3") + ", " + accessor(5125, corners, "SCALAR") +
                     (color > 0 ? ", " + accessor(color, points, "VEC3") : "") + "]";
  const std::string attributes = color > 0 ? "{\"POSITION\": 0, \"COLOR_0\": 2}" : "{\"POSITION\": 0}";
  const std::string ids = color > 0 ? "{\"POSITION\": 0, \"COLOR_0\": 1}" : "{\"POSITION\": 0}";
  sample.primitive = "{\"attributes\": " + attributes +
                     ", \"indices\": 1, \"extensions\": {\"KHR_draco_mesh_compression\": {\"bufferView\": 0, \"attributes\": " + ids +
                     "}}}";
  sample.more = ", \"extensionsUsed\": [\"KHR_draco_mesh_compression\"], \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]";
  return sample;
}

// The same mesh without compression.
Sample plain(const std::vector<double>& positions, const std::vector<std::uint32_t>& corners) {
  Sample sample;
  sample.binary.clear();
  for (const double x : positions) { put(sample.binary, static_cast<float>(x)); }
  const std::size_t begin = sample.binary.size();
  for (const std::uint32_t corner : corners) { put(sample.binary, corner); }
  sample.views = "[{\"buffer\": 0, \"byteLength\": " + std::to_string(begin) +
                 "}, {\"buffer\": 0, \"byteOffset\": " + std::to_string(begin) +
                 ", \"byteLength\": " + std::to_string(sample.binary.size() - begin) + "}]";
  sample.accessors = "[{\"bufferView\": 0, \"componentType\": 5126, \"count\": " + std::to_string(positions.size() / 3) +
                     ", \"type\": \"VEC3\"}, {\"bufferView\": 1, \"componentType\": 5125, \"count\": " + std::to_string(corners.size()) +
                     ", \"type\": \"SCALAR\"}]";
  return sample;
}

std::string square_stream(int color_type, bool normalized) {
  std::string positions, colors;
  for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F}) { put(positions, x); }
  for (int i = 0; i < 12; ++i) { color_type == 2 ? put(colors, std::uint8_t{51}) : put(colors, 0.2F); }
  return raw_stream(4, {0, 1, 2, 0, 2, 3}, {{0, 9, 3, 0, positions}, {2, color_type, 3, normalized ? 1 : 0, colors}});
}

}  // namespace

// A value is rounded to a step of the extent, which is at most 6, over 2^8 - 1; and then to a float.
TEST_CASE("Draco: each encoding of a torus has its triangles, with all corners within half a step") {
  for (const File& file : files) {
    const draco::Mesh mesh = mesh_of(file);
    CAPTURE(file.name);
    REQUIRE(mesh.attributes.size() == 3);
    const draco::Attribute &positions = mesh.attributes[0], &places = mesh.attributes[1];
    REQUIRE((positions.components == 3 && places.components == 2));
    std::vector<torus::Place> corners;
    double largest = 0.0;
    for (const std::uint32_t point : mesh.corners) {
      REQUIRE(point < mesh.points);
      const auto at = [&](std::size_t k) { return static_cast<int>(std::lround(file.n * places.values[2 * point + k])); };
      corners.push_back({at(0), at(1)});
      const glm::dvec3 expected = torus::position(file.n, corners.back());
      for (int k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(positions.values[3 * point + static_cast<std::size_t>(k)] - expected[k]));
      }
    }
    CHECK(largest <= 0.5 * 6.0 / 255.0 + 1e-6);
    std::multiset<torus::Triangle> triangles;
    for (std::size_t i = 0; i < corners.size(); i += 3) { triangles.insert(torus::turned({corners[i], corners[i + 1], corners[i + 2]})); }
    CHECK(triangles == torus::triangles(file.n, false));
  }
}

TEST_CASE("Draco: damaged streams end in a mesh or in a refusal") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::vector<std::string> streams{square_stream(2, true)};
  for (const File& file : files) { streams.push_back(bytes_of(file)); }
  for (const std::string& stream : streams) {
    for (int run = 0; run < 200; ++run) {
      std::string damaged = stream;
      if (run % 4 == 0) { damaged.resize(random() % stream.size()); }
      for (int flips = run % 4; flips > 0; --flips) {
        char& byte = damaged[random() % damaged.size()];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ 1U << random() % 8);
      }
      CAPTURE(run);
      std::string fault;
      const auto mesh = draco::read_mesh(damaged, fault);
      REQUIRE(mesh.has_value() == fault.empty());
      if (!mesh) { continue; }
      REQUIRE(std::all_of(mesh->corners.begin(), mesh->corners.end(), [&](std::uint32_t point) { return point < mesh->points; }));
      REQUIRE(std::all_of(mesh->attributes.begin(), mesh->attributes.end(),
                          [&](const draco::Attribute& a) { return a.values.empty() || a.values.size() == mesh->points * a.components; }));
    }
  }
}

TEST_CASE("Draco: what is not read is refused with what it is and where") {
  std::string fault;
  std::string stream = square_stream(9, false);
  stream[6] = 1;
  CHECK_FALSE(draco::read_mesh(stream, fault));
  CHECK(fault == "byte 11 of the Draco stream: expected version 2.2 of Draco, found version 2.1");
  stream[6] = 2;
  stream[7] = 0;
  CHECK_FALSE(draco::read_mesh(stream, fault));
  CHECK(fault == "byte 11 of the Draco stream: clouds of points are not read");
}

TEST_CASE("glTF: a mesh compressed by Draco reads as the same numbers without compression") {
  for (const File& file : files) {
    const draco::Mesh mesh = mesh_of(file);
    CAPTURE(file.name);
    const apps::Model one = read("a.glb", packed(bytes_of(file), mesh.points, mesh.corners.size()).glb());
    const apps::Model other = read("a.glb", plain(mesh.attributes[0].values, mesh.corners).glb());
    CHECK(one.corners == other.corners);
    CHECK(std::equal(one.positions.begin(), one.positions.end(), other.positions.begin(), other.positions.end(),
                     [](const auto& a, const auto& b) { return glm::length(a - b) < 1e-6; }));  // of floats below 3
  }
}

TEST_CASE("glTF: compressed colours are scaled once, by the stream or by the accessor") {
  for (const auto& [type, normalized, accessor] : {std::tuple{9, false, 5126}, {2, true, 5126}, {2, true, 5121}, {2, false, 5121}}) {
    CAPTURE(type, normalized, accessor);
    const apps::Model model = read("a.glb", packed(square_stream(type, normalized), 4, 6, accessor).glb());
    REQUIRE(model.polygons() == 2);
    REQUIRE(model.materials.size() >= 1);
    // Colours of polygons have steps of 1/255.
    CHECK(std::any_of(model.materials.begin(), model.materials.end(), [](const apps::ModelMaterial& material) {
      return material.reflectance && glm::length(*material.reflectance - radiosity::Color(0.2)) < 0.01;
    }));
  }
}

TEST_CASE("glTF: numbers for readers without Draco are used where they are, and else the compressed ones") {
  const std::string extension =
      "\"extensions\": {\"KHR_draco_mesh_compression\": {\"bufferView\": 9, \"attributes\": {\"POSITION\": 0}}}, ";
  Sample sample;
  const apps::Model expected = read("a.gltf", sample.embedded());
  sample.primitive.insert(1, extension);
  CHECK(read("a.gltf", sample.embedded()).positions == expected.positions);
  Sample compressed = packed(square_stream(9, false), 4, 6);
  compressed.accessors.insert(2, "\"bufferView\": 7, ");  // a view that does not exist
  const apps::Model model = read("a.glb", compressed.glb());
  CHECK(model.positions == expected.positions);
  CHECK(model.corners == expected.corners);
  CHECK(models::error("a.glb", packed(square_stream(9, false).substr(0, 60), 4, 6).glb()).find("of the Draco stream") != std::string::npos);
}
