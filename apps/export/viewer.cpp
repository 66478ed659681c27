// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <raycast/box.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/result/mesh.hpp>

#include "apps/bytes.hpp"
#include "apps/export/export_mesh.hpp"
#include "apps/html_document.hpp"
#include "apps/json.hpp"
#include "embedded/export.hpp"

namespace apps {
namespace {

// The arrays that the script decodes, little-endian. Radiance times exposure as half floats, because a screen shows no higher precision.
struct Arrays {
  std::string positions;             // three floats per position, relative to the centre, in units of the size
  std::string corner_vertex;         // 32 bits
  std::string corner_light;          // three halves
  std::string face_size, face_node;  // 8 and 32 bits per face: number of corners; node number of the leaf, see `parent`
  std::string face_seen;             // 8 bits: 0 if another object covers at least a part of it
  std::string parent;                // 32 bits per node: its parent, or its own number for an input face
};

}  // namespace

std::string viewer_page(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Camera& camera, double exposure,
                        const std::string& title, const std::string& sentence) {
  const radiosity::Mesh mesh = with_sky_of_file(file, without_suns(file, solution.shown()));
  raycast::Box box;
  for (const glm::dvec3& p : mesh.positions) { box.extend(p); }
  const glm::dvec3 centre = box.empty() ? glm::dvec3(0.0) : box.centre();
  const double size = std::max(box.diameter(), 1e-300);

  Arrays arrays;
  for (const glm::dvec3& p : mesh.positions) {
    for (int k = 0; k < 3; ++k) { put(arrays.positions, static_cast<float>((p[k] - centre[k]) / size)); }
  }
  for (const radiosity::MeshFace& face : mesh.faces) {
    put(arrays.face_size, static_cast<std::uint8_t>(face.corner_count));
    put(arrays.face_node, face.node);
    put(arrays.face_seen, static_cast<std::uint8_t>(is_covered(solution, face.node) ? 0 : 1));
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      put(arrays.corner_vertex, mesh.corners[c].vertex);
      for (int k = 0; k < 3; ++k) {
        const double light = mesh.corners[c].radiosity[k] * exposure / std::acos(-1.0);
        put(arrays.corner_light, glm::packHalf1x16(static_cast<float>(std::clamp(light, 0.0, 65504.0))));
      }
    }
  }
  for (std::uint32_t i = 0; i < solution.hierarchy.size(); ++i) {
    const bool top = solution.hierarchy[i].is_cluster() || radiosity::is_input_face(solution.hierarchy, i);
    put(arrays.parent, top ? i : solution.hierarchy[i].parent);
  }

  JsonWriter json;
  json.open_object();
  json.fields("title", title, "sentence", sentence);
  json.key("cameras").open_array();
  const auto add = [&](const radiosity::Camera& c) {
    const radiosity::PictureSize picture = c.size.value_or(radiosity::PictureSize{});
    json.object("name", c.name, "eye", (c.eye - centre) / size, "forward", glm::normalize(c.forward), "up", glm::normalize(c.up), "fov",
                c.field_of_view, "aspect", static_cast<double>(picture.width) / picture.height);
  };
  add(camera);
  for (const radiosity::Camera& c : file.cameras) {
    if (c.name != camera.name) { add(c); }
  }
  json.close();
  json.fields("metres", size, "positions", base64(arrays.positions), "cornerVertex", base64(arrays.corner_vertex), "cornerLight",
              base64(arrays.corner_light), "faceSize", base64(arrays.face_size), "faceNode", base64(arrays.face_node), "faceSeen",
              base64(arrays.face_seen), "parent", base64(arrays.parent));
  json.close();
  return html_document(title, embedded::export_viewer_css,
                       with_script(embedded::export_viewer_html, json.text(), embedded::export_viewer_js));
}

}  // namespace apps
