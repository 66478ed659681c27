// SPDX-License-Identifier: MIT

// Each repair is told with a place: that of the worst where a size is told, else that of the first, in words that fit the format.

#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "apps/intake/model.hpp"
#include "catch.hpp"
#include "models.hpp"
#include "seed.hpp"

namespace {

// Squares far apart in a row, that at `worst` bent by 2 cm, another one by 1 cm.
struct BentSquares {
  std::size_t count, slight, worst;
  explicit BentSquares(std::mt19937& random)
      : count(4 + random() % 20), slight(random() % count), worst((slight + 1 + random() % (count - 1)) % count) {}

  [[nodiscard]] glm::vec3 corner(std::size_t square, std::size_t i) const {
    const float bend = square == worst ? 0.04F : square == slight ? 0.02F : 0.0F;
    return {3.0F * static_cast<float>(square) + (i == 1 || i == 2 ? 1.0F : 0.0F), i >= 2 ? 1.0F : 0.0F, i == 2 ? bend : 0.0F};
  }
  [[nodiscard]] std::string numbers(std::size_t square, std::size_t i) const {
    const glm::vec3 p = corner(square, i);
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
  }
};

template <class T>
void put_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The note that has `part`.
std::string note_with(const std::vector<std::string>& notes, const std::string& part) {
  for (const std::string& note : notes) {
    if (note.find(part) != std::string::npos) { return note; }
  }
  return "";
}

}  // namespace

TEST_CASE("places of repairs: OBJ tells the line of the worst, binary PLY its number, VRML and MGF the included file, too") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 12; ++k) {
    const BentSquares squares(random);
    std::string obj, mgf, points, faces;
    std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(4 * squares.count) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(squares.count) +
                      "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (std::size_t s = 0; s < squares.count; ++s) {
      for (std::size_t i = 0; i < 4; ++i) {
        obj += "v " + squares.numbers(s, i) + "\n";
        points += squares.numbers(s, i) + ",\n";
        mgf += "v v" + std::to_string(i) + " =\n\tp " + squares.numbers(s, i) + "\n";
        put_bytes(ply, squares.corner(s, i));
      }
      mgf += "f v0 v1 v2 v3\n";  // the last of nine lines
    }
    for (std::uint32_t s = 0; s < squares.count; ++s) {
      obj += "f";
      put_bytes(ply, std::uint8_t{4});
      for (std::uint32_t i = 0; i < 4; ++i) {
        obj += " " + std::to_string(4 * s + i + 1);
        faces += std::to_string(4 * s + i) + ", ";
        put_bytes(ply, 4 * s + i);
      }
      obj += "\n";
      faces += "-1,\n";
    }
    const std::string wrl =
        "#VRML V1.0 ascii\nSeparator { Coordinate3 { point [\n" + points + "] }\nIndexedFaceSet { coordIndex [\n" + faces + "] } }\n";
    const std::string told = "2 polygons were not planar by up to 10 mm: split, worst at ";
    const auto line = [](std::size_t number) { return "line " + std::to_string(number); };
    const std::string number = "polygon " + std::to_string(squares.worst + 1) + " of " + std::to_string(squares.count);
    INFO("squares " << squares.count << ", " << squares.slight << ", " << squares.worst);
    const std::string at_obj = line(4 * squares.count + squares.worst + 1);
    CHECK(note_with(models::scene("a.obj", obj).notes, "not planar") == told + at_obj);
    CHECK(note_with(models::scene("a.ply", ply).notes, "not planar") == told + number);
    CHECK(note_with(models::scene("a.mgf", mgf).notes, "not planar") == told + line(9 * squares.worst + 9));
    CHECK(note_with(models::scene("a.mgf", "i part.mgf\n", {{"part.mgf", mgf}}).notes, "not planar") ==
          told + line(9 * squares.worst + 9) + " of part.mgf");
    const std::string at_wrl = line(2 + 4 * squares.count + 2 + squares.worst + 1);
    CHECK(note_with(models::scene("a.wrl", wrl).notes, "not planar") == told + at_wrl);
    CHECK(note_with(models::scene("a.wrl", "#VRML V1.0 ascii\nWWWInline { name \"part.wrl\" }\n", {{"part.wrl", wrl}}).notes,
                    "not planar") == told + at_wrl + " of part.wrl");
    // Within a scene of ours.
    const std::string scene = "material m reflectance .5 emission 1\nmesh rows file ";
    const auto within = [&](const std::string& name, const std::string& bytes) {
      const apps::SceneResult result = apps::parse_scene(scene + name + " material m\n", models::beside({{name, bytes}}));
      REQUIRE(result.file);
      return note_with(result.file->notes, "not planar");
    };
    CHECK(within("a.obj", obj) == "rows: " + told + at_obj + " of a.obj");
    CHECK(within("a.ply", ply) == "rows: " + told + number + " in a.ply");
  }
}

TEST_CASE("places of repairs: glTF tells mesh, primitive, node and number, and what has no size where it was first") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 12; ++k) {
    // Triangles without shared vertices, one of them without area, in the second primitive of the second node.
    const std::size_t count = 2 + random() % 10, flat = random() % count;
    std::string bytes;
    for (std::size_t t = 0; t < count; ++t) {
      const float x = 3.0F * static_cast<float>(t), y = t == flat ? 0.0F : 1.0F;
      for (const float v : {x, 0.0F, 0.0F, x + 1.0F, 0.0F, 0.0F, x + 2.0F, y, 0.0F}) { put_bytes(bytes, v); }
    }
    const std::string size = std::to_string(bytes.size()), all = std::to_string(3 * count);
    const std::string gltf = R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": )" + size +
                             R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" + size +
                             R"(}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": )" + all +
                             R"(, "type": "VEC3"}, {"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 1}}, {"attributes": {"POSITION": 0}}]}],
      "nodes": [{"children": [1]}, {"name": "row", "mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";
    const std::vector<std::string> notes = models::scene("a.gltf", gltf, {{"a.bin", bytes}}).notes;
    CHECK(note_with(notes, "no area") == "1 polygon has no area: left out, at polygon " + std::to_string(flat + 1) + " of " +
                                             std::to_string(count) + " in meshes[0].primitives[1] of nodes[1] 'row'");
  }
}
