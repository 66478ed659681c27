// SPDX-License-Identifier: MIT
// OBJ with colours behind the positions of its vertices, as MeshLab, Blender and others read and write them: sRGB in [0, 1], exposed.
#include <array>
#include <charconv>

#include "apps/color.hpp"
#include "apps/export/export_mesh.hpp"
#include "apps/text.hpp"

namespace apps::exported {
namespace {

void append(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text += ' ';
  text.append(digits.data(), end);
}

std::string write_obj(const ExportMesh& mesh, const Tone& tone) {
  std::string text =
      "# halflight: x y z r g b, colours sRGB of radiance times " + shortest(tone.exposure) + ", tone " + name(tone.curve) + "\n";
  for (const ExportVertex& vertex : mesh.vertices) {
    text += 'v';
    for (int k = 0; k < 3; ++k) { append(text, vertex.position[k]); }
    const radiosity::Color color = tone(vertex.radiosity);
    for (int k = 0; k < 3; ++k) { text += formatted(" %.4f", srgb_encode(color[k])); }
    text += '\n';
  }
  for (const ExportVertex& vertex : mesh.vertices) {
    text += "vn";
    for (int k = 0; k < 3; ++k) { text += formatted(" %.6g", vertex.normal[k]); }
    text += '\n';
  }
  std::size_t group = 0;
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    while (group < mesh.groups.size() && mesh.groups[group].first_face == f) {
      std::string name = mesh.groups[group++].name;
      for (char& c : name) { c = c == '\n' || c == '\r' ? ' ' : c; }
      text += "o " + name + "\n";
    }
    text += 'f';
    for (const std::uint32_t v : mesh.face(f)) { text += ' ' + std::to_string(v + 1) + "//" + std::to_string(v + 1); }
    text += '\n';
  }
  return text;
}

}  // namespace

extern const ExportFormat obj;
constinit const ExportFormat obj{".obj", write_obj};

}  // namespace apps::exported
