// SPDX-License-Identifier: MIT
#include "apps/export/export_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/handles.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

namespace apps {
namespace {

// For each object: is it a flat polygon that lies in the plane of a leaf and covers at least a part of it, such as a lamp in a ceiling?
// Viewers would show either of the two at random, because both have the same depth.
std::vector<bool> covering(const radiosity::Mesh& mesh, const radiosity::Solution& solution,
                           const std::vector<radiosity::InputSurface>& inputs, const std::vector<raycast::PlacedObject>& objects) {
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (objects[i].flat() && !objects[i].solid() && objects[i].sheet_count() == 1) { pieces.push_back(i); }
  }
  std::vector<bool> result(objects.size(), false);
  for (const radiosity::MeshFace& face : mesh.faces) {
    if (!is_covered(solution, face.node)) { continue; }
    raycast::Box leaf;
    for (std::uint32_t k = 0; k < face.corner_count; ++k) { leaf.extend(mesh.positions[mesh.corners[face.first_corner + k].vertex]); }
    const radiosity::InputSurface& input = inputs[face.surface];
    const glm::dvec3 normal = objects[input.object].project(input.sheet, leaf.centre()).normal;
    for (const std::uint32_t i : pieces) {
      const double near = 1e-6 * leaf.diameter();
      if (result[i] || i == input.object || !objects[i].bounds().meets(leaf, near)) { continue; }
      const raycast::SurfacePoint at = objects[i].project(0, leaf.centre());
      const double height = std::abs(glm::dot(at.position - leaf.centre(), at.normal));
      result[i] = glm::dot(at.normal, normal) > 0.999999 && height <= near;
    }
  }
  return result;
}

}  // namespace

bool is_covered(const radiosity::Solution& solution, std::uint32_t node) {
  return solution.area[node] < (1.0 - 1e-9) * solution.hierarchy[node].area;
}

radiosity::Mesh in_depth_order(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh) {
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(file.scene);
  const std::vector<raycast::PlacedObject> objects = radiosity::placed_objects(file.scene);
  const double step = 1e-4 * radiosity::lit_bounds(file.scene).diameter();
  const std::vector<bool> before = covering(mesh, solution, inputs, objects);
  std::vector<bool> fixed(mesh.positions.size(), false);  // vertices of leaves that are not covered: moving them would open gaps
  for (const radiosity::MeshFace& face : mesh.faces) {
    for (std::uint32_t k = 0; k < face.corner_count && !is_covered(solution, face.node); ++k) {
      fixed[mesh.corners[face.first_corner + k].vertex] = true;
    }
  }
  radiosity::Mesh out = mesh;
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> moved;  // by vertex and new position
  std::vector<glm::dvec3> outline;
  for (const radiosity::MeshFace& face : mesh.faces) {
    outline.clear();
    for (std::uint32_t k = 0; k < face.corner_count; ++k) { outline.push_back(mesh.positions[mesh.corners[face.first_corner + k].vertex]); }
    const glm::dvec3 area = brep::vector_area(outline);
    if (!(glm::length(area) > 0.0)) { continue; }
    const glm::dvec3 normal = glm::normalize(area);
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      std::uint32_t& vertex = out.corners[face.first_corner + k].vertex;
      const double by = (fixed[vertex] ? 0.0 : -step) + (before[inputs[face.surface].object] ? step : 0.0);
      if (by == 0.0) { continue; }
      const glm::dvec3 place = outline[k] + by * normal;
      const auto number = static_cast<std::uint32_t>(out.positions.size());
      const auto [known, is_new] = moved.emplace(std::tuple(vertex, place.x, place.y, place.z), number);
      if (is_new) { out.positions.push_back(place); }
      vertex = known->second;
    }
  }
  return out;
}

radiosity::Mesh without_suns(const SceneFile& file, const radiosity::Mesh& mesh) {
  if (file.suns.empty()) { return mesh; }
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(file.scene);
  std::vector<std::uint32_t> number(mesh.positions.size(), brep::invalid_index);
  radiosity::Mesh out;
  for (radiosity::MeshFace face : mesh.faces) {
    if (std::find(file.suns.begin(), file.suns.end(), inputs[face.surface].object) != file.suns.end()) { continue; }
    const std::uint32_t first = std::exchange(face.first_corner, static_cast<std::uint32_t>(out.corners.size()));
    for (std::uint32_t c = first; c < first + face.corner_count; ++c) {
      radiosity::MeshCorner corner = mesh.corners[c];
      if (number[corner.vertex] == brep::invalid_index) {
        number[corner.vertex] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[corner.vertex]);
      }
      corner.vertex = number[corner.vertex];
      out.corners.push_back(corner);
    }
    out.faces.push_back(face);
  }
  return out;
}

radiosity::Mesh with_sky_of_file(const SceneFile& file, radiosity::Mesh mesh) {
  const EnlargedSky& sky = file.sky;
  if (sky.factor == 1.0) { return mesh; }
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(file.scene);
  std::vector<bool> of_sky(mesh.positions.size(), false);
  for (const radiosity::MeshFace& face : mesh.faces) {
    if (std::find(sky.objects.begin(), sky.objects.end(), inputs[face.surface].object) == sky.objects.end()) { continue; }
    for (std::uint32_t k = 0; k < face.corner_count; ++k) { of_sky[mesh.corners[face.first_corner + k].vertex] = true; }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (of_sky[v]) { mesh.positions[v] = sky.centre + (mesh.positions[v] - sky.centre) / sky.factor; }
  }
  return mesh;
}

}  // namespace apps
