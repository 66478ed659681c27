// SPDX-License-Identifier: MIT
#pragma once

// Baked light as a texture: an atlas in which every planar face has a rectangle of its own, and texture coordinates for the corners of
// polygons. A face is what the intake has merged: the two triangles of a quadrilateral, a wall in a hundred parts. No surface has to be
// unwrapped: a rectangle lies in the face's plane, along its longest side, its texels are squares of one size. It is a texel wider than the
// face all around, and what lies beside the face has the light of the nearest place on it, so that bilinear filtering never reaches another
// face. Rectangles are packed on shelves, the highest first (Coffman et al. 1980).
//
// Best for large faces: for each triangle of a finely meshed curved surface a rectangle is waste, and vertex colours say as much.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/baked_light.hpp>
#include <radiosity/intake/intake.hpp>

namespace radiosity {

// A rectangle of the atlas, and the plane that it shows.
struct LightmapChart {
  std::size_t polygon = 0;                            // that lies in it; of several the first
  glm::dvec3 origin{0.0};                             // a corner of the bounds of what lies in it: the middle of texel (1, 1)
  glm::dvec3 u{0.0}, v{0.0};                          // directions of its sides, of length 1
  double width = 0.0, height = 0.0;                   // of these bounds
  std::uint32_t columns = 0, rows = 0, x = 0, y = 0;  // size and place in texels
};

// The chart of these points, in the plane across `normal`; one of its sides runs along `along`. Nothing when one of these is zero, or both
// have one direction.
[[nodiscard]] std::optional<LightmapChart> make_chart(std::size_t polygon, std::span<const glm::dvec3> points, const glm::dvec3& normal,
                                                      const glm::dvec3& along);

struct Lightmap {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;         // radiosity, W/m2; rows from the first one, v = 0; unused ones are 0
  std::vector<glm::vec2> coordinates;    // u v of each corner of the input, in [0, 1]; of polygons without light 0 0
  std::vector<std::uint8_t> has_texels;  // of each polygon
  std::vector<LightmapChart> charts;
  double texel = 0.0;  // side of a texel as used, in the unit of the positions

  // Where a point lies in the atlas.
  [[nodiscard]] glm::vec2 coordinate(const LightmapChart& chart, const glm::dvec3& point) const;
  // The light of each texel of the chart: light(point in its plane).
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

// An atlas with room for these charts, still without light. `texel` and `most` as below.
[[nodiscard]] Lightmap lay_out(std::vector<LightmapChart> charts, double texel, std::uint32_t most = 8192);

// `texel`: the wanted side of a texel; it is doubled until no side of the atlas is longer than `most` (at least 64). `input` is what the
// parts of the light were made of.
[[nodiscard]] Lightmap make_lightmap(const BakedLight& light, const PolygonView& input, double texel, std::uint32_t most = 8192);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/lightmap.cpp>
#endif
