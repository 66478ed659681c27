// SPDX-License-Identifier: MIT
#pragma once

// Baked light as a texture: an atlas in which every polygon has a rectangle of its own, and texture coordinates for its corners. Polygons
// are planar, so no surface has to be unwrapped: a rectangle lies in the polygon's plane, along its longest side, its texels are squares of
// one size. It is a texel wider than the polygon all around, and what lies beside the polygon has the light of the nearest place on it, so
// that bilinear filtering never reaches another polygon. Rectangles are packed on shelves, the highest first (Coffman et al. 1980).
//
// Give this the polygons that the user has, large ones best: for each triangle of a fine mesh a rectangle is waste, and vertex colours say
// as much.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/baked_light.hpp>
#include <radiosity/intake/intake.hpp>

namespace radiosity {

struct Lightmap {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;         // radiosity, W/m2; rows from the first one, v = 0; unused ones are 0
  std::vector<glm::vec2> coordinates;    // u v of each corner of the input, in [0, 1]; of polygons without light 0 0
  std::vector<std::uint8_t> has_texels;  // of each polygon
  double texel = 0.0;                    // side of a texel as used, in the unit of the positions
};

// `texel`: the wanted side of a texel; it is doubled until no side of the atlas is longer than `most` (at least 64). `input` is what the
// parts of the light were made of.
[[nodiscard]] Lightmap make_lightmap(const BakedLight& light, const PolygonView& input, double texel, std::uint32_t most = 8192);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/lightmap.cpp>
#endif
