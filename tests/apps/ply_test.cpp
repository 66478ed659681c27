// SPDX-License-Identifier: MIT
#include "catch.hpp"

#include <cstring>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/export/export_mesh.hpp"
#include "small_mesh.hpp"

namespace {

using radiosity::Color;
using std::numbers::pi;

struct PlyVertex {
  float position[3];
  float normal[3];
  unsigned char rgb[3];
};
struct PlyFace {
  std::vector<std::int32_t> vertices;
  float radiosity[3];
  std::int32_t surface;
};
struct Ply {
  std::string header;
  std::vector<PlyVertex> vertices;
  std::vector<PlyFace> faces;
  bool exact = false;  // nothing is left over
};

// Reads back what to_ply() writes, on a little-endian machine.
Ply read(const std::string& bytes) {
  Ply ply;
  const std::string last = "end_header\n";
  std::size_t at = bytes.find(last) + last.size();
  ply.header = bytes.substr(0, at);
  const auto count = [&](const std::string& element) {
    return static_cast<std::size_t>(std::stoul(ply.header.substr(ply.header.find(element) + element.size())));
  };
  const auto take = [&](void* to, std::size_t size) {
    REQUIRE(at + size <= bytes.size());
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  };
  ply.vertices.resize(count("element vertex "));
  for (PlyVertex& v : ply.vertices) {
    take(v.position, 12);
    take(v.normal, 12);
    take(v.rgb, 3);
  }
  ply.faces.resize(count("element face "));
  for (PlyFace& f : ply.faces) {
    unsigned char corners = 0;
    take(&corners, 1);
    f.vertices.resize(corners);
    take(f.vertices.data(), 4U * corners);
    take(f.radiosity, 12);
    take(&f.surface, 4);
  }
  ply.exact = at == bytes.size();
  return ply;
}

std::vector<radiosity::InputSurface> named_surfaces() { return {{0, 0, 0, "floor"}, {1, 0, 0, "room.x0"}}; }

// Two quadrilaterals with a common edge, vertices 1 and 2; `right` is the colour of the second at that edge.
radiosity::Mesh two_faces(const Color& right) {
  radiosity::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const Color c(0.5 * pi);
  mesh.corners = {{0, c}, {1, c}, {2, c}, {3, c}, {1, right}, {4, c}, {5, c}, {2, right}};
  mesh.faces.resize(2);
  mesh.faces[0].corner_count = mesh.faces[1].corner_count = 4;
  mesh.faces[1].first_corner = 4;
  mesh.faces[1].surface = 1;
  mesh.faces[1].radiosity = Color(1.0, 2.0, 3.0);
  return mesh;
}

}  // namespace

TEST_CASE("vertices are doubled only where the colours of their faces differ") {
  CHECK(read(apps::to_ply(two_faces(Color(0.5 * pi)), named_surfaces(), 1.0)).vertices.size() == 6);
  CHECK(read(apps::to_ply(two_faces(Color(0.9 * pi)), named_surfaces(), 1.0)).vertices.size() == 8);
  // A difference that no byte shows does not count, and neither does one in what is too bright to show.
  CHECK(read(apps::to_ply(two_faces(Color(0.500001 * pi)), named_surfaces(), 1.0)).vertices.size() == 6);
  CHECK(read(apps::to_ply(two_faces(Color(0.9 * pi)), named_surfaces(), 10.0)).vertices.size() == 6);
}

TEST_CASE("a PLY file reads back: positions, colours, raw radiosity, surfaces") {
  const Ply ply = read(apps::to_ply(two_faces(Color(0.9 * pi)), named_surfaces(), 1.0));
  CHECK(ply.exact);
  CHECK(ply.header.find("format binary_little_endian 1.0\n") != std::string::npos);
  CHECK(ply.header.find("comment surface 1 room.x0\n") != std::string::npos);
  CHECK(ply.header.find("property float radiosity_r\n") != std::string::npos);
  REQUIRE(ply.faces.size() == 2);
  CHECK(ply.faces[0].vertices == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(ply.faces[1].surface == 1);
  CHECK(ply.faces[1].radiosity[2] == 3.0F);
  const PlyVertex& corner = ply.vertices[static_cast<std::size_t>(ply.faces[1].vertices[3])];
  CHECK(corner.position[0] == 1.0F);
  CHECK(corner.position[1] == 1.0F);
  CHECK(int{corner.rgb[0]} == 243);           // linear 0.9
  CHECK(int{ply.vertices[0].rgb[1]} == 188);  // linear 0.5
}

TEST_CASE("a vertex at a crease is doubled, with a normal for each side") {
  radiosity::Mesh mesh = two_faces(Color(0.5 * pi));
  for (std::size_t c = 0; c < 8; ++c) { mesh.corners[c].normal = c < 4 ? glm::vec3{0, 0, 1} : glm::vec3{0, 0.6f, 0.8f}; }
  const Ply ply = read(apps::to_ply(mesh, named_surfaces(), 1.0));
  CHECK(ply.header.find("property float nz\n") != std::string::npos);
  CHECK(ply.vertices.size() == 8);
  for (std::size_t f = 0; f < 2; ++f) {
    for (const std::int32_t v : ply.faces[f].vertices) {
      CHECK(ply.vertices[static_cast<std::size_t>(v)].normal[1] == (f == 0 ? 0.0F : 0.6F));
    }
  }
}

TEST_CASE("triangles and an empty mesh are written, too") {
  radiosity::Mesh mesh;
  CHECK(read(apps::to_ply(mesh, {}, 1.0)).exact);
  add_face(mesh, {{{0, 0, 0}, Color(1.0)}, {{1, 0, 0}, Color(1.0)}, {{0, 1, 0}, Color(1.0)}});
  const Ply ply = read(apps::to_ply(mesh, named_surfaces(), 1.0));
  CHECK(ply.exact);
  CHECK(ply.faces[0].vertices.size() == 3);
}
