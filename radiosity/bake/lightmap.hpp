// SPDX-License-Identifier: MIT
#pragma once

// Baked light as a texture: an atlas in which every planar face has a rectangle of its own, and texture coordinates for the corners of
// the polygons. A face is what the intake has merged: the two triangles of a quadrilateral, or a wall given in a hundred parts. No
// unwrapping is needed: each rectangle lies in the plane of its face, parallel to the longest side, and all texels are squares of one
// size. The rectangle extends one texel beyond the face on all sides. Texels beside the face take the light of the nearest place on it,
// so that bilinear filtering never mixes in another face. Rectangles are packed on shelves, the highest first (Coffman et al. 1980).
//
// Best for large faces. On finely meshed curved surfaces every triangle would need a rectangle, and vertex colours hold as much.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/baked_light.hpp>

namespace radiosity {

// A rectangle of the atlas and the plane that it shows.
struct LightmapChart {
  std::size_t polygon = 0;                            // first polygon that lies in it
  glm::dvec3 origin{0.0};                             // corner of the bounds of the face; it is the centre of texel (1, 1)
  glm::dvec3 u{0.0}, v{0.0};                          // unit vectors along its sides
  double width = 0.0, height = 0.0;                   // size of these bounds
  std::uint32_t columns = 0, rows = 0, x = 0, y = 0;  // size and position in texels
};

// The chart of these points in the plane with this normal, with a side along `along`. Nothing if one of these vectors is zero or both are
// parallel.
[[nodiscard]] std::optional<LightmapChart> make_chart(std::size_t polygon, std::span<const glm::dvec3> points, const glm::dvec3& normal,
                                                      const glm::dvec3& along);

struct Lightmap {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;         // radiosity, W/m2; row by row, beginning with v = 0; unused texels are 0
  std::vector<glm::vec2> coordinates;    // u v of each corner of the input, in [0, 1]; 0 0 for polygons without light
  std::vector<std::uint8_t> has_texels;  // per polygon
  std::vector<LightmapChart> charts;
  double texel = 0.0;  // side of a texel as used, in the unit of the positions

  // Texture coordinates of a point.
  [[nodiscard]] glm::vec2 coordinate(const LightmapChart& chart, const glm::dvec3& point) const;
  // Sets each texel of the chart to light(point), where `point` is the texel's centre in the chart's plane.
  template <class Light>
  void fill(const LightmapChart& chart, Light&& light) {
    for (std::uint32_t row = 0; row < chart.rows; ++row) {
      for (std::uint32_t column = 0; column < chart.columns; ++column) {
        const glm::dvec3 point = chart.origin + texel * ((column - 1.0) * chart.u + (row - 1.0) * chart.v);
        texels[std::size_t{chart.y + row} * width + chart.x + column] = glm::vec3(light(point));
      }
    }
  }
};

// An atlas with room for these charts and no light yet. `texel` and `most` as below.
[[nodiscard]] Lightmap lay_out(std::vector<LightmapChart> charts, double texel, std::uint32_t most = 8192);

// `texel`: desired side of a texel, doubled until no side of the atlas is longer than `most` texels (at least 64). `input`: the polygons
// from which the parts of the light were made.
[[nodiscard]] Lightmap make_lightmap(const BakedLight& light, const PolygonView& input, double texel, std::uint32_t most = 8192);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/lightmap.cpp>
#endif
