// SPDX-License-Identifier: MIT
#pragma once

// Groups the rays of a pixel of a gathered picture into fragments: pieces of one surface that are lit once each (gather_picture.hpp).

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// What the rays of one pixel meet of one surface with one orientation.
struct Fragment {
  std::uint32_t x = 0, y = 0;
  float share = 0.0f;  // area share of the pixel
  FinalGather::Place place;
};

// Memory that a fragment takes until the picture is done: itself, its light and its direct light (gather_picture.cpp), and what is known
// of the edges of shadows there (smooth_shadows.hpp).
inline constexpr std::uint64_t bytes_of_fragment = sizeof(Fragment) + 2 * sizeof(Color) + sizeof(double) + 1;

// The width of a pixel at the distance of a point, or at `nearest` if that is farther: between two surfaces that touch, an eye may lie on
// both (off_surfaces.hpp), and widths must not be 0.
struct PixelSize {
  glm::dvec3 eye{0.0};
  double angle = 0.0, nearest = 0.0;
  [[nodiscard]] double operator()(const glm::dvec3& p) const { return angle * std::max(nearest, glm::length(p - eye)); }
};

// Do these two places, seen through one pixel, belong to one fragment? Not if one part of a surface hides another, or across a crease.
[[nodiscard]] bool one_piece(const FinalGather::Place& a, const FinalGather::Place& b, const PixelSize& pixel_size);

// Adds the fragments of the pixel (x, y), given what each of its rays sees.
void add_fragments(const FinalGather& light, std::uint32_t x, std::uint32_t y, std::span<const std::optional<FinalGather::Place>> seen,
                   const PixelSize& pixel_size, std::vector<Fragment>& out);

inline constexpr std::uint32_t block_side = 8;  // pixels

// Adds the irradiance from the lamps to the fragments `own`, which belong to one block and one surface. Where the surface fills the
// block, visibility is computed for a lattice of pixels and interpolated between them, if all of these see the whole lamp or none of it,
// or otherwise where the neighbours agree. The shadow of a thin object can pass between the lattice pixels if the lamp is narrow, because
// then the shadow is as thin. So for a narrow lamp the pixels along the border of the block are checked, too, which any longer shadow
// crosses; if they differ, every pixel is computed.
void add_direct_light(const FinalGather& light, std::span<const std::uint32_t> own, const std::vector<Fragment>& fragments,
                      std::vector<Color>& irradiance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/fragments.cpp>
#endif
