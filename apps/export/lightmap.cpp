// SPDX-License-Identifier: MIT
#include "apps/export/export_mesh.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>

#include <radiosity/bake/baked_light.hpp>
#include <radiosity/bake/lightmap.hpp>
#include <radiosity/geometry/chord.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/result/mesh.hpp>

namespace apps {
namespace {

constexpr double usual_texels = 1 << 20;

double texel_for(double area) { return std::sqrt(area / usual_texels); }

LightTexture texture(const radiosity::Lightmap& map, const radiosity::Tone& tone) {
  LightTexture result{radiosity::Picture(map.width, map.height), map.texel};
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    const radiosity::Color light(map.texels[i]);
    result.picture.set(i, tone(light), light);
  }
  return result;
}

// The leaves of one input face, projected onto the plane of its chart.
class FlatFace {
 public:
  FlatFace(const radiosity::Mesh& mesh, const radiosity::Solution& solution, std::span<const std::uint32_t> faces) {
    for (const bool covered : {false, true}) {  // leaves with light of their own; covered ones only if there are no others
      for (const std::uint32_t f : faces) {
        if (covered == !(solution.area[mesh.faces[f].node] > 0.0)) { add(mesh, mesh.faces[f]); }
      }
      if (!triangles_.empty()) { break; }
    }
  }

  [[nodiscard]] std::optional<radiosity::LightmapChart> chart(std::size_t number) const {
    return radiosity::make_chart(number, points_, normal_, longest_);
  }

  void flatten(const radiosity::LightmapChart& chart) {
    std::vector<raycast::Box> boxes(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t c : triangles_[t]) { boxes[t].extend(flat(chart, points_[c])); }
    }
    for (glm::dvec3& p : points_) { p = flat(chart, p); }
    tree_ = raycast::Bvh(boxes);
  }

  // The light at a point of the chart's plane.
  [[nodiscard]] radiosity::Color light(const radiosity::LightmapChart& chart, const glm::dvec3& point) const {
    const glm::dvec3 at = flat(chart, point);
    const auto weights = [&](std::uint32_t t) {
      return radiosity::nearest_in_triangle({points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]}, at);
    };
    const auto mix = [&](std::uint32_t t, const std::vector<glm::dvec3>& of) {
      const glm::dvec3 weight = weights(t);
      return weight.x * of[triangles_[t][0]] + weight.y * of[triangles_[t][1]] + weight.z * of[triangles_[t][2]];
    };
    const auto best = raycast::nearest(tree_, at, [&](std::uint32_t t) {
      const glm::dvec3 gap = mix(t, points_) - at;
      return glm::dot(gap, gap);
    });
    return best ? mix(*best, light_) : radiosity::Color(0.0);
  }

 private:
  static glm::dvec3 flat(const radiosity::LightmapChart& chart, const glm::dvec3& p) {
    return {glm::dot(p - chart.origin, chart.u), glm::dot(p - chart.origin, chart.v), 0.0};
  }

  void add(const radiosity::Mesh& mesh, const radiosity::MeshFace& face) {
    const auto begin = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      points_.push_back(mesh.positions[mesh.corners[face.first_corner + k].vertex]);
      light_.push_back(mesh.corners[face.first_corner + k].radiosity);
    }
    for (std::uint32_t k = 2; k < face.corner_count; ++k) { triangles_.push_back({begin, begin + k - 1, begin + k}); }
    const std::span<const glm::dvec3> outline = std::span(points_).subspan(begin);
    normal_ += brep::vector_area(outline);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const glm::dvec3 side = outline[(k + 1) % outline.size()] - outline[k];
      if (glm::dot(side, side) > glm::dot(longest_, longest_)) { longest_ = side; }
    }
  }

  std::vector<glm::dvec3> points_;
  std::vector<radiosity::Color> light_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  glm::dvec3 normal_{0.0}, longest_{0.0};
  raycast::Bvh tree_;
};

}  // namespace

std::optional<LightTexture> solution_texture(const radiosity::Solution& solution, const radiosity::Tone& tone, std::optional<double> texel,
                                             ExportMesh& mesh) {
  const radiosity::Mesh& source = solution.mesh;
  std::map<std::uint32_t, std::vector<std::uint32_t>> faces;  // by input face
  for (std::uint32_t f = 0; f < source.faces.size(); ++f) {
    faces[radiosity::input_face(solution.hierarchy, source.faces[f].node)].push_back(f);
  }
  std::vector<radiosity::LightmapChart> charts;
  double area = 0.0;
  for (const auto& [root, its_faces] : faces) {
    const auto chart = FlatFace(source, solution, its_faces).chart(root);
    if (!chart) { continue; }
    charts.push_back(*chart);
    area += chart->width * chart->height;
  }
  radiosity::Lightmap map = radiosity::lay_out(std::move(charts), texel.value_or(texel_for(area)));
  if (map.texels.empty()) { return std::nullopt; }
  mesh.coordinates.assign(mesh.corners.size(), glm::vec2(0.0F));
  for (const radiosity::LightmapChart& chart : map.charts) {
    const std::vector<std::uint32_t>& its_faces = faces[static_cast<std::uint32_t>(chart.polygon)];
    FlatFace flat(source, solution, its_faces);
    flat.flatten(chart);
    map.fill(chart, [&](const glm::dvec3& point) { return flat.light(chart, point); });
    for (const std::uint32_t f : its_faces) {
      for (std::uint32_t k = 0; k < source.faces[f].corner_count; ++k) {
        const std::uint32_t vertex = source.corners[source.faces[f].first_corner + k].vertex;
        mesh.coordinates[mesh.first_corner[f] + k] = map.coordinate(chart, source.positions[vertex]);
      }
    }
  }
  return texture(map, tone);
}

std::optional<LightTexture> given_texture(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Tone& tone,
                                          std::optional<double> texel, ExportMesh& mesh) {
  if (!file.given) { return std::nullopt; }
  const GivenPolygons& given = *file.given;
  const radiosity::BakedLight light(file.scene, solution, given.parts, given.first_object);
  std::vector<std::uint32_t> material;
  const radiosity::PolygonView view = given.in_scene(material);
  double area = 0.0;
  std::vector<glm::dvec3> outline;
  for (std::size_t f = 0; f < given.count(); ++f) {
    if (!given.sound(f)) { continue; }
    outline.clear();
    for (const std::uint32_t v : given.polygon(f)) { outline.push_back(given.placed[v]); }
    if (outline.size() >= 3) { area += glm::length(brep::vector_area(outline)); }
  }
  const radiosity::Lightmap map = radiosity::make_lightmap(light, view, texel.value_or(texel_for(area)));
  if (map.texels.empty()) { return std::nullopt; }
  mesh.coordinates.clear();
  for (std::size_t f = 0; f < given.count(); ++f) {
    if (!given.sound(f)) { continue; }
    mesh.coordinates.insert(mesh.coordinates.end(), map.coordinates.begin() + given.first_corner[f],
                            map.coordinates.begin() + given.first_corner[f + 1]);
  }
  return texture(map, tone);
}

}  // namespace apps
