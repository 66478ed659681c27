// SPDX-License-Identifier: MIT
// OBJ with a colour after the position of each vertex, as MeshLab, Blender and others read and write it: sRGB in [0, 1], exposed. With a
// lightmap each corner has its position in it, by the convention of the format from the lower left.
#include <radiosity/camera/tone.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/text.hpp"

namespace apps::exported {
namespace {

std::string one_line(std::string name) {
  for (char& c : name) { c = c == '\n' || c == '\r' ? ' ' : c; }
  return name;
}

// Programs that read OBJ take y as vertical axis, and ours is z, so the scene is rotated; the user's own vertices are not.
std::string write_obj(const ExportMesh& mesh, const radiosity::Tone& tone) {
  const bool turn = mesh.z_up && !mesh.as_given;
  const auto turned = [&](const glm::dvec3& v) { return turn ? glm::dvec3(v.x, v.z, -v.y) : v; };
  std::string text = "# halflight: x y z r g b, colours sRGB of radiance times " + shortest(tone.exposure) + ", tone " + name(tone.curve) +
                     ", " + (mesh.z_up && !turn ? "z" : "y") + " is up\n";
  if (!mesh.coordinates.empty()) { text += "# texture coordinates: of the lightmap " + one_line(mesh.texture_name) + "\n"; }
  for (const ExportVertex& vertex : mesh.vertices) {
    text += 'v';
    const glm::dvec3 place = turned(vertex.position);
    for (int k = 0; k < 3; ++k) { text += ' ' + shortest(place[k]); }
    const radiosity::Color color = tone(vertex.radiosity);
    for (int k = 0; k < 3; ++k) { text += formatted(" %.4f", radiosity::srgb_encode(color[k])); }
    text += '\n';
  }
  for (const ExportVertex& vertex : mesh.vertices) {
    text += "vn";
    const glm::dvec3 normal = turned(glm::dvec3(vertex.normal));
    for (int k = 0; k < 3; ++k) { text += formatted(" %.6g", normal[k]); }
    text += '\n';
  }
  for (const glm::vec2& at : mesh.coordinates) { text += formatted("vt %.9g", double{at.x}) + formatted(" %.9g\n", 1.0 - double{at.y}); }
  std::size_t group = 0;
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    while (group < mesh.groups.size() && mesh.groups[group].first_face == f) { text += "o " + one_line(mesh.groups[group++].name) + "\n"; }
    text += 'f';
    for (std::uint32_t c = mesh.first_corner[f]; c < mesh.first_corner[f + 1]; ++c) {
      const std::string vertex = std::to_string(mesh.corners[c] + 1);
      text += ' ' + vertex + '/' + (mesh.coordinates.empty() ? "" : std::to_string(c + 1)) + '/' + vertex;
    }
    text += '\n';
  }
  return text;
}

}  // namespace

constinit const ExportFormat obj{".obj", write_obj};

}  // namespace apps::exported
