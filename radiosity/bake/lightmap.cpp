// SPDX-License-Identifier: MIT
#include <radiosity/bake/lightmap.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/polygon.hpp>

#include <raycast/inline.hpp>

namespace radiosity {

namespace lightmap::detail {

// The plane of a polygon with two directions in it, and the polygon's bounds along these.
struct Chart {
  std::size_t polygon = 0;
  glm::dvec3 origin{0.0}, u{0.0}, v{0.0};
  double width = 0.0, height = 0.0;
  std::uint32_t columns = 0, rows = 0, x = 0, y = 0;
};

inline std::optional<Chart> chart_of(const PolygonView& input, std::size_t p) {
  std::vector<glm::dvec3> outline;
  for (std::size_t c = input.first_corner[p]; c < input.first_corner[p + 1]; ++c) { outline.push_back(input.positions[input.corners[c]]); }
  if (outline.size() < 3) { return std::nullopt; }
  const glm::dvec3 area = brep::vector_area(outline);
  glm::dvec3 longest{0.0};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 side = outline[(i + 1) % outline.size()] - outline[i];
    if (glm::dot(side, side) > glm::dot(longest, longest)) { longest = side; }
  }
  if (!(glm::length(area) > 0.0) || !(glm::length(longest) > 0.0)) { return std::nullopt; }
  Chart chart;
  chart.polygon = p;
  chart.v = glm::normalize(glm::cross(area, longest));
  chart.u = glm::normalize(glm::cross(chart.v, area));
  glm::dvec2 lo(0.0), hi(0.0);
  for (const glm::dvec3& corner : outline) {
    const glm::dvec2 at(glm::dot(corner - outline[0], chart.u), glm::dot(corner - outline[0], chart.v));
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  chart.origin = outline[0] + lo.x * chart.u + lo.y * chart.v;
  chart.width = hi.x - lo.x;
  chart.height = hi.y - lo.y;
  return chart;
}

// Places the charts, which come highest first, on shelves of this width; the height that they need.
inline std::uint64_t pack(std::vector<Chart>& charts, std::uint64_t width) {
  std::uint64_t x = 0, y = 0, shelf = 0;
  for (Chart& chart : charts) {
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

// Sizes and places of the charts with texels of this size; false when they do not fit.
inline bool arrange(std::vector<Chart>& charts, double texel, std::uint32_t most, Lightmap& map) {
  std::uint64_t area = 0, widest = 1;
  for (Chart& chart : charts) {
    const double columns = std::ceil(chart.width / texel) + 2.0, rows = std::ceil(chart.height / texel) + 2.0;
    if (!(columns <= most && rows <= most)) { return false; }
    chart.columns = static_cast<std::uint32_t>(columns);
    chart.rows = static_cast<std::uint32_t>(rows);
    area += std::uint64_t{chart.columns} * chart.rows;
    widest = std::max<std::uint64_t>(widest, chart.columns);
  }
  std::stable_sort(charts.begin(), charts.end(), [](const Chart& a, const Chart& b) { return a.rows > b.rows; });
  const auto side = static_cast<std::uint64_t>(std::ceil(std::sqrt(1.1 * static_cast<double>(area))));
  const std::uint64_t width = std::min<std::uint64_t>(std::max(side, widest), most), height = pack(charts, width);
  if (height > most) { return false; }
  map.width = static_cast<std::uint32_t>(width);
  map.height = static_cast<std::uint32_t>(height);
  return true;
}

}  // namespace lightmap::detail

HALFLIGHT_INLINE Lightmap make_lightmap(const BakedLight& light, const PolygonView& input, double texel, std::uint32_t most) {
  Lightmap map;
  map.coordinates.resize(input.corners.size(), glm::vec2(0.0F));
  map.has_texels.resize(input.count(), 0);
  std::vector<lightmap::detail::Chart> charts;
  for (std::size_t p = 0; p < input.count() && p < light.polygons(); ++p) {
    const std::size_t first = input.first_corner[p];
    if (first >= input.corners.size() || input.corners[first] >= input.positions.size()) { continue; }
    if (!light.radiosity(p, input.positions[input.corners[first]])) { continue; }  // a polygon with light has sound corners
    if (const auto chart = lightmap::detail::chart_of(input, p)) { charts.push_back(*chart); }
  }
  most = std::max(most, 64U);
  if (charts.empty() || !(texel > 0.0) || !std::isfinite(texel)) { return map; }
  // Each doubling makes a chart smaller, down to 3 texels squared; more charts than fit even so are left out.
  while (charts.size() > std::size_t{most / 3} * (most / 3)) { charts.pop_back(); }
  for (map.texel = texel; !lightmap::detail::arrange(charts, map.texel, most, map) && std::isfinite(map.texel); map.texel *= 2.0) {}
  map.texels.resize(std::size_t{map.width} * map.height, glm::vec3(0.0F));
  for (const lightmap::detail::Chart& chart : charts) {
    map.has_texels[chart.polygon] = 1;
    // The middle of texel (1, 1) is the corner of the bounds, so the ring around is outside of the polygon.
    for (std::uint32_t row = 0; row < chart.rows; ++row) {
      for (std::uint32_t column = 0; column < chart.columns; ++column) {
        const glm::dvec3 point = chart.origin + map.texel * ((column - 1.0) * chart.u + (row - 1.0) * chart.v);
        const Color color = light.radiosity(chart.polygon, point).value_or(Color(0.0));
        map.texels[std::size_t{chart.y + row} * map.width + chart.x + column] = glm::vec3(color);
      }
    }
    for (std::size_t c = input.first_corner[chart.polygon]; c < input.first_corner[chart.polygon + 1]; ++c) {
      const glm::dvec3 from = input.positions[input.corners[c]] - chart.origin;
      const glm::dvec2 at(chart.x + 1.5 + glm::dot(from, chart.u) / map.texel, chart.y + 1.5 + glm::dot(from, chart.v) / map.texel);
      map.coordinates[c] = glm::vec2(at / glm::dvec2(map.width, map.height));
    }
  }
  return map;
}

}  // namespace radiosity
