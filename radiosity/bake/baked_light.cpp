// SPDX-License-Identifier: MIT
#include <radiosity/bake/baked_light.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/finite.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>

#include <radiosity/geometry/chord.hpp>

namespace radiosity {

HALFLIGHT_INLINE BakedLight::BakedLight(const Scene& scene, const Solution& solution, PolygonParts parts, std::uint32_t first_object)
    : parts_{std::move(parts)} {
  std::uint32_t sheets = 0, first = 0;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (i == first_object) { first = sheets; }
    if (i >= first_object) { first_sheet_.push_back(sheets - first); }
    sheets += scene.objects[i].shape->sheet_count();
  }
  sheets_.resize(sheets - first);
  const Mesh& mesh = solution.mesh;
  for (const MeshFace& face : mesh.faces) {
    if (face.surface < first || !(solution.area[face.node] > 0.0)) { continue; }  // skip: covered faces have no light of their own
    const auto begin = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const MeshCorner& corner = mesh.corners[face.first_corner + k];
      corners_.push_back({mesh.positions[corner.vertex], corner.radiosity});
    }
    for (std::uint32_t k = 2; k < face.corner_count; ++k) {
      sheets_[face.surface - first].triangles.push_back({begin, begin + k - 1, begin + k});
    }
  }
  for (Sheet& sheet : sheets_) {
    std::vector<raycast::Box> boxes;
    for (const auto& triangle : sheet.triangles) {
      raycast::Box& box = boxes.emplace_back();
      for (const std::uint32_t c : triangle) { box.extend(corners_[c].position); }
    }
    sheet.tree = raycast::Bvh(boxes);
  }
}

HALFLIGHT_INLINE std::optional<PolygonPart> BakedLight::front(std::size_t polygon) const {
  if (polygon >= polygons()) { return std::nullopt; }
  std::optional<PolygonPart> found;
  for (const PolygonPart& part : parts_.of(polygon)) {
    if (part.back) { continue; }
    if (found) { return std::nullopt; }
    found = part;
  }
  return found;
}

HALFLIGHT_INLINE std::optional<BakedLight::Found> BakedLight::nearest(const Sheet& sheet, const glm::dvec3& point) const {
  const auto place = [&](std::uint32_t i) {
    std::array<glm::dvec3, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) { p[k] = corners_[sheet.triangles[i][k]].position; }
    const glm::dvec3 weight = nearest_in_triangle(p, point);
    const glm::dvec3 gap = weight.x * p[0] + weight.y * p[1] + weight.z * p[2] - point;
    return std::pair(weight, glm::dot(gap, gap));
  };
  const auto best = raycast::nearest(sheet.tree, point, [&](std::uint32_t i) { return place(i).second; });
  if (!best) { return std::nullopt; }
  const auto [weight, squared] = place(*best);
  Found found{squared};
  for (int k = 0; k < 3; ++k) { found.radiosity += weight[k] * corners_[sheet.triangles[*best][static_cast<std::size_t>(k)]].radiosity; }
  return found;
}

HALFLIGHT_INLINE std::optional<Color> BakedLight::radiosity(std::size_t polygon, const glm::dvec3& point, FaceSide side) const {
  if (polygon >= polygons()) { return std::nullopt; }
  std::optional<Found> best;
  bool best_asked = false;  // is `best` on the requested side?
  for (const PolygonPart& part : parts_.of(polygon)) {
    const bool asked = part.back == (side == FaceSide::back);
    if (best && best_asked && !asked) { continue; }
    const std::optional<Found> found = nearest(sheets_[first_sheet_[part.object] + part.sheet], point);
    if (!found || (best && best_asked == asked && !(found->squared < best->squared))) { continue; }
    best = found;
    best_asked = asked;
  }
  if (!best) { return std::nullopt; }
  return best->radiosity;
}

namespace baking::detail {

// Interior angle of a polygon at its corner k, in radians; 0 if a side at this corner has no length.
inline double angle(const PolygonView& input, std::size_t polygon, std::size_t k) {
  const std::size_t first = input.first_corner[polygon], n = input.first_corner[polygon + 1] - first;
  const auto at = [&](std::size_t i) { return input.positions[input.corners[first + i % n]]; };
  const glm::dvec3 u = at(k + n - 1) - at(k), v = at(k + 1) - at(k);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

struct Mean {
  Color sum{0.0};
  double weight = 0.0;
  void add(const Color& color, double its_weight) {
    sum += its_weight * color;
    weight += its_weight;
  }
  void operator+=(const Mean& other) {
    sum += other.sum;
    weight += other.weight;
  }
  [[nodiscard]] Color color() const { return weight > 0.0 ? sum / weight : sum; }
};

struct ByCoordinates {
  bool operator()(const glm::dvec3& a, const glm::dvec3& b) const { return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3); }
};

}  // namespace baking::detail

HALFLIGHT_INLINE BakedColors baked_colors(const BakedLight& light, const PolygonView& input) {
  BakedColors result;
  result.corner.resize(input.corners.size());
  std::vector<baking::detail::Mean> vertices(input.positions.size());
  std::vector<std::pair<std::size_t, std::uint32_t>> without;  // corner, vertex
  for (std::size_t p = 0; p < input.count(); ++p) {
    for (std::size_t c = input.first_corner[p]; c < input.first_corner[p + 1] && c < input.corners.size(); ++c) {
      const std::uint32_t v = input.corners[c];
      if (v >= input.positions.size()) {
        ++result.without;
        continue;
      }
      if (const std::optional<Color> color = light.radiosity(p, input.positions[v])) {
        result.corner[c] = *color;
        vertices[v].add(*color, std::max(baking::detail::angle(input, p, c - input.first_corner[p]), 1e-6));
      } else {
        without.emplace_back(c, v);
      }
    }
  }
  if (!without.empty()) {  // use the mean of other corners at the same place
    std::map<glm::dvec3, baking::detail::Mean, baking::detail::ByCoordinates> places;
    // Coordinates that are not finite cannot be ordered.
    const auto is_place = [&](std::size_t v) { return brep::is_finite(input.positions[v]); };
    for (const auto& [corner, v] : without) {
      if (is_place(v)) { places[input.positions[v]]; }
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!is_place(v)) { continue; }
      const auto place = places.find(input.positions[v]);
      if (place != places.end()) { place->second += vertices[v]; }
    }
    for (const auto& [corner, v] : without) {
      if (!is_place(v)) { continue; }
      result.corner[corner] = places[input.positions[v]].color();
      if (!(vertices[v].weight > 0.0)) { vertices[v] = {result.corner[corner], 1.0}; }
    }
  }
  result.without += without.size();
  for (const baking::detail::Mean& vertex : vertices) { result.vertex.push_back(vertex.color()); }
  return result;
}

}  // namespace radiosity
