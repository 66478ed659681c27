// SPDX-License-Identifier: MIT
#include <radiosity/bake/lightmap.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

namespace radiosity {

namespace lightmap::detail {

// The polygons of one planar face, which share a chart.
struct Shared {
  std::size_t first = 0;  // first of the polygons
  std::vector<glm::dvec3> corners;
  glm::dvec3 normal{0.0}, longest{0.0};  // sum of the vector areas; longest side

  void add(const PolygonView& input, std::size_t p) {
    const std::size_t begin = corners.size();
    for (std::size_t c = input.first_corner[p]; c < input.first_corner[p + 1]; ++c) {
      corners.push_back(input.positions[input.corners[c]]);
    }
    const std::span<const glm::dvec3> outline = std::span(corners).subspan(begin);
    normal += brep::vector_area(outline);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec3 side = outline[(i + 1) % outline.size()] - outline[i];
      if (glm::dot(side, side) > glm::dot(longest, longest)) { longest = side; }
    }
  }
};

// Places the charts, sorted by decreasing height, on shelves of this width; returns the height that is needed.
inline std::uint64_t pack(std::vector<LightmapChart>& charts, std::uint64_t width) {
  std::uint64_t x = 0, y = 0, shelf = 0;
  for (LightmapChart& chart : charts) {
    if (x + chart.columns > width) {
      y += shelf;
      x = shelf = 0;
    }
    chart.x = static_cast<std::uint32_t>(x);
    chart.y = static_cast<std::uint32_t>(std::min<std::uint64_t>(y, 0xffffffff));
    x += chart.columns;
    shelf = std::max<std::uint64_t>(shelf, chart.rows);
  }
  return y + shelf;
}

// Sizes and places the charts with texels of this size; returns false when they do not fit.
inline bool arrange(std::vector<LightmapChart>& charts, double texel, std::uint32_t most, Lightmap& map) {
  std::uint64_t area = 0, widest = 1;
  for (LightmapChart& chart : charts) {
    const double columns = std::ceil(chart.width / texel) + 2.0, rows = std::ceil(chart.height / texel) + 2.0;
    if (!(columns <= most && rows <= most)) { return false; }
    chart.columns = static_cast<std::uint32_t>(columns);
    chart.rows = static_cast<std::uint32_t>(rows);
    area += std::uint64_t{chart.columns} * chart.rows;
    widest = std::max<std::uint64_t>(widest, chart.columns);
  }
  std::stable_sort(charts.begin(), charts.end(), [](const LightmapChart& a, const LightmapChart& b) { return a.rows > b.rows; });
  const auto side = static_cast<std::uint64_t>(std::ceil(std::sqrt(1.1 * static_cast<double>(area))));
  const std::uint64_t width = std::min<std::uint64_t>(std::max(side, widest), most), height = pack(charts, width);
  if (height > most) { return false; }
  map.width = static_cast<std::uint32_t>(width);
  map.height = static_cast<std::uint32_t>(height);
  return true;
}

}  // namespace lightmap::detail

HALFLIGHT_INLINE std::optional<LightmapChart> make_chart(std::size_t polygon, std::span<const glm::dvec3> points, const glm::dvec3& normal,
                                                         const glm::dvec3& along) {
  const glm::dvec3 across = glm::cross(normal, along);
  if (points.empty() || !(glm::length(normal) > 0.0) || !(glm::length(across) > 0.0)) { return std::nullopt; }
  LightmapChart chart;
  chart.polygon = polygon;
  chart.v = glm::normalize(across);
  chart.u = glm::normalize(glm::cross(chart.v, normal));
  glm::dvec2 lo(0.0), hi(0.0);
  for (const glm::dvec3& point : points) {
    const glm::dvec2 at(glm::dot(point - points[0], chart.u), glm::dot(point - points[0], chart.v));
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  chart.origin = points[0] + lo.x * chart.u + lo.y * chart.v;
  chart.width = hi.x - lo.x;
  chart.height = hi.y - lo.y;
  return chart;
}

HALFLIGHT_INLINE glm::vec2 Lightmap::coordinate(const LightmapChart& chart, const glm::dvec3& point) const {
  const glm::dvec3 from = point - chart.origin;
  const glm::dvec2 at(chart.x + 1.5 + glm::dot(from, chart.u) / texel, chart.y + 1.5 + glm::dot(from, chart.v) / texel);
  return {at / glm::dvec2(width, height)};
}

HALFLIGHT_INLINE Lightmap lay_out(std::vector<LightmapChart> charts, double texel, std::uint32_t most) {
  Lightmap map;
  most = std::max(most, 64U);
  if (charts.empty() || !(texel > 0.0) || !std::isfinite(texel)) { return map; }
  // Doubling the texel shrinks every chart, to 3 x 3 texels at least; charts that do not fit even then are left out.
  while (charts.size() > std::size_t{most / 3} * (most / 3)) { charts.pop_back(); }
  for (map.texel = texel; !lightmap::detail::arrange(charts, map.texel, most, map) && std::isfinite(map.texel); map.texel *= 2.0) {}
  map.texels.resize(std::size_t{map.width} * map.height, glm::vec3(0.0F));
  map.charts = std::move(charts);
  return map;
}

HALFLIGHT_INLINE Lightmap make_lightmap(const BakedLight& light, const PolygonView& input, double texel, std::uint32_t most) {
  std::vector<lightmap::detail::Shared> faces;
  std::vector<std::optional<std::size_t>> face_of(input.count());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_of_sheet;
  for (std::size_t p = 0; p < input.count() && p < light.polygons(); ++p) {
    const std::size_t first = input.first_corner[p];
    if (first >= input.corners.size() || input.corners[first] >= input.positions.size()) { continue; }
    if (!light.radiosity(p, input.positions[input.corners[first]])) { continue; }  // a polygon with light has valid corners
    face_of[p] = faces.size();
    if (const auto part = light.front(p)) {
      face_of[p] = face_of_sheet.emplace(std::pair(part->object, part->sheet), faces.size()).first->second;
    }
    if (face_of[p] == faces.size()) { faces.emplace_back().first = p; }
    faces[*face_of[p]].add(input, p);
  }
  std::vector<LightmapChart> charts;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (const auto chart = make_chart(f, faces[f].corners, faces[f].normal, faces[f].longest)) { charts.push_back(*chart); }
  }
  Lightmap map = lay_out(std::move(charts), texel, most);
  map.coordinates.resize(input.corners.size(), glm::vec2(0.0F));
  map.has_texels.resize(input.count(), 0);
  std::vector<const LightmapChart*> chart_of(faces.size(), nullptr);
  for (LightmapChart& chart : map.charts) {
    chart_of[chart.polygon] = &chart;
    chart.polygon = faces[chart.polygon].first;
    map.fill(chart, [&](const glm::dvec3& point) { return light.radiosity(chart.polygon, point).value_or(Color(0.0)); });
  }
  for (std::size_t p = 0; p < input.count(); ++p) {
    const LightmapChart* const chart = face_of[p] ? chart_of[*face_of[p]] : nullptr;
    if (chart == nullptr) { continue; }
    map.has_texels[p] = 1;
    for (std::size_t c = input.first_corner[p]; c < input.first_corner[p + 1]; ++c) {
      map.coordinates[c] = map.coordinate(*chart, input.positions[input.corners[c]]);
    }
  }
  return map;
}

}  // namespace radiosity
