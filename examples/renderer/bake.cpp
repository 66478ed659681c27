// SPDX-License-Identifier: MIT
// An OBJ in, colours out: `example_bake FILE.obj >lit.obj` writes the same vertices and triangles in the same order, each vertex with
// its radiosity as a colour. Materials are known by name: `lamp` shines. Without a file it takes the room below, whose walls the file has
// in two triangles each; a vertex colour says nothing of what lies between, so they are cut first, as a renderer's mesh would be.

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <radiosity/bake/bake.hpp>

namespace {

const char* const room = R"(v 0 0 0
v 3 0 0
v 3 2 0
v 0 2 0
v 0 0 2
v 3 0 2
v 3 2 2
v 0 2 2
v 1 0.5 1.99
v 2 0.5 1.99
v 2 1.5 1.99
v 1 1.5 1.99
usemtl white
f 1 2 3
f 1 3 4
f 5 8 7
f 5 7 6
f 1 5 6
f 1 6 2
f 3 7 8
f 3 8 4
usemtl red
f 1 4 8
f 1 8 5
usemtl green
f 2 6 7
f 2 7 3
usemtl lamp
f 9 12 11
f 9 11 10
)";

struct Triangles {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices, material;

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t k = 0; k < 3; ++k) { positions.push_back(0.5F * (positions[3 * a + k] + positions[3 * b + k])); }
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  }
  // Each triangle becomes four. What lies in one place stays several vertices: to weld them is the intake's work.
  void cut() {
    const std::vector<std::uint32_t> corners = std::move(indices), of = std::move(material);
    for (std::size_t t = 0; t < of.size(); ++t) {
      const std::uint32_t a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
      material.insert(material.end(), 4, of[t]);
    }
  }
};

}  // namespace

int main(int count, char** arguments) {
  std::ifstream file(count > 1 ? arguments[1] : "");
  std::istringstream text(room);
  std::istream& in = count > 1 ? static_cast<std::istream&>(file) : text;

  std::vector<radiosity::Material> materials;
  Triangles mesh;
  std::uint32_t current = 0;
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      for (float x = 0; words >> x;) { mesh.positions.push_back(x); }
    } else if (word == "f") {
      for (std::uint32_t v = 0; words >> v; words.ignore(99, ' ')) { mesh.indices.push_back(v - 1); }
      mesh.material.push_back(current);
    } else if (word == "usemtl" && words >> word) {
      current = static_cast<std::uint32_t>(materials.size());
      const bool lamp = word == "lamp";
      const radiosity::Color paint = word == "red"     ? radiosity::Color{0.6, 0.1, 0.1}
                                     : word == "green" ? radiosity::Color{0.1, 0.5, 0.1}
                                                       : radiosity::Color(0.7);
      materials.push_back({word, lamp ? radiosity::Color(0.0) : paint, radiosity::Color(lamp ? 50.0 : 0.0)});
    }
  }
  if (count < 2) { mesh.cut(); }

  radiosity::BakeOptions options;
  options.solve.epsilon = 0.02;  // coarse, for an example: the error is in the first line
  options.solve.min_area = 2e-4;
  const radiosity::BakeOutcome outcome = radiosity::bake({mesh.positions, mesh.indices, materials, mesh.material}, options);
  if (!outcome.baked) {
    for (const std::string& sentence : outcome.failure.sentences) { std::fprintf(stderr, "%s\n", sentence.c_str()); }
    return 1;
  }
  const radiosity::Baked& baked = *outcome.baked;
  if (const auto& error = baked.audit.surface_error) {
    std::printf("# error %.1f %% of the reflected light\n", 100.0 * error->relative_l2);
  }
  for (const radiosity::Change& change : baked.changes) { std::printf("# %s\n", radiosity::sentence(change).c_str()); }
  for (std::size_t v = 0; v < baked.colors.vertex.size(); ++v) {
    const radiosity::Color& b = baked.colors.vertex[v];
    const float* const p = &mesh.positions[3 * v];
    std::printf("v %g %g %g %.3f %.3f %.3f\n", p[0], p[1], p[2], b.x, b.y, b.z);  // W/m2
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::printf("f %u %u %u\n", mesh.indices[i] + 1, mesh.indices[i + 1] + 1, mesh.indices[i + 2] + 1);
  }
}
