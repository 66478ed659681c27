// SPDX-License-Identifier: MIT
#include "apps/export/export_mesh.hpp"

#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include <brep/handles.hpp>
#include <brep/polygon.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/bake/baked_light.hpp>
#include <radiosity/hierarchy/corner_normal.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/mesh_file.hpp"

namespace apps {
namespace {

constexpr std::size_t most_groups = 2000;  // more names are of no use, and slow viewers down

glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : otherwise;
}

}  // namespace

ExportMesh solution_mesh(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& in_place) {
  const radiosity::Mesh mesh = in_depth_order(file, solution, in_place);
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(file.scene);
  const std::vector<raycast::PlacedObject> objects = radiosity::placed_objects(file.scene);
  const radiosity::Mesh shown = with_sky_of_file(file, mesh);  // the normals are those of the objects where they are solved
  ExportMesh out;
  out.cameras = file.cameras;
  // By position: the newest of its vertices, and a chain to the others.
  std::vector<std::uint32_t> newest(mesh.positions.size(), brep::invalid_index), next;
  std::uint32_t object = brep::invalid_index;
  for (const radiosity::MeshFace& face : mesh.faces) {
    const radiosity::InputSurface& input = inputs[face.surface];
    if (input.object != object && (out.groups.empty() || file.scene.objects.size() <= most_groups)) {
      const bool one = file.scene.objects.size() > most_groups;
      out.groups.push_back(
          {one ? "scene" : file.scene.objects[input.object].name, out.faces(), static_cast<std::uint32_t>(out.vertices.size())});
    }
    object = input.object;
    std::vector<glm::dvec3> outline;
    for (std::uint32_t k = 0; k < face.corner_count; ++k) { outline.push_back(mesh.positions[mesh.corners[face.first_corner + k].vertex]); }
    const glm::dvec3 flat = unit(brep::vector_area(outline), {0, 0, 1});
    const glm::dvec3 middle = std::accumulate(outline.begin(), outline.end(), glm::dvec3{0.0}) / static_cast<double>(outline.size());
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + k];
      const glm::dvec3 normal = unit(radiosity::corner_normal(objects[input.object], input.sheet, outline[k], middle), flat);
      const ExportVertex vertex{shown.positions[corner.vertex], normal, corner.radiosity};
      std::uint32_t v = newest[corner.vertex];
      while (v != brep::invalid_index && v >= out.groups.back().first_vertex &&
             (out.vertices[v].position != vertex.position || out.vertices[v].normal != vertex.normal ||
              out.vertices[v].radiosity != vertex.radiosity)) {
        v = next[v];
      }
      if (v == brep::invalid_index || v < out.groups.back().first_vertex) {
        v = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(vertex);
        next.push_back(std::exchange(newest[corner.vertex], v));
      }
      out.corners.push_back(v);
    }
    out.first_corner.push_back(static_cast<std::uint32_t>(out.corners.size()));
  }
  return out;
}

std::optional<ExportMesh> given_mesh(const SceneFile& file, const radiosity::Solution& solution) {
  if (!file.given) { return std::nullopt; }
  const GivenPolygons& given = *file.given;
  const radiosity::BakedLight light(file.scene, solution, given.parts, given.first_object);
  std::vector<std::uint32_t> material;
  const radiosity::BakedColors colors = radiosity::baked_colors(light, given.in_scene(material));
  ExportMesh out;
  out.z_up = given.z_up;
  out.as_given = true;
  out.groups.push_back({"mesh", 0, 0});
  std::vector<glm::dvec3> normals(given.positions.size(), glm::dvec3(0.0));
  std::vector<glm::dvec3> outline;
  for (std::size_t f = 0; f < given.count(); ++f) {
    if (!given.sound(f)) { continue; }
    const std::span<const std::uint32_t> face = given.polygon(f);
    outline.clear();
    for (const std::uint32_t v : face) { outline.push_back(given.positions[v]); }
    const glm::dvec3 normal = outline.size() < 3 ? glm::dvec3(0.0) : brep::vector_area(outline);
    for (const std::uint32_t v : face) { normals[v] += normal; }
    out.corners.insert(out.corners.end(), face.begin(), face.end());
    out.first_corner.push_back(static_cast<std::uint32_t>(out.corners.size()));
  }
  for (std::size_t v = 0; v < given.positions.size(); ++v) {
    out.vertices.push_back({given.positions[v], unit(normals[v], {0, 0, 1}), colors.vertex[v]});
  }
  return out;
}

ExportMesh split_at_seams(const ExportMesh& mesh, std::vector<glm::vec2>& of_vertex) {
  ExportMesh out;
  out.first_corner = mesh.first_corner;
  out.z_up = mesh.z_up;
  out.as_given = mesh.as_given;
  out.cameras = mesh.cameras;
  out.texture = mesh.texture;
  out.texture_name = mesh.texture_name;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;  // vertices of a group remain adjacent
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const ExportGroup& group = mesh.groups[g];
    out.groups.push_back({group.name, group.first_face, static_cast<std::uint32_t>(out.vertices.size())});
    const std::uint32_t end = g + 1 < mesh.groups.size() ? mesh.groups[g + 1].first_face : mesh.faces();
    for (std::uint32_t c = mesh.first_corner[group.first_face]; c < mesh.first_corner[end]; ++c) {
      const glm::vec2 at = mesh.coordinates[c];
      const auto [entry, is_new] = known.emplace(std::tuple(mesh.corners[c], at.x, at.y), static_cast<std::uint32_t>(out.vertices.size()));
      if (is_new) {
        out.vertices.push_back(mesh.vertices[mesh.corners[c]]);
        of_vertex.push_back(at);
      }
      out.corners.push_back(entry->second);
    }
  }
  return out;
}

const ExportFormat* export_format(std::string_view path) {
  for (const ExportFormat* const format : {&exported::glb, &exported::obj}) {
    if (has_ending(path, format->ending)) { return format; }
  }
  return nullptr;
}

}  // namespace apps
