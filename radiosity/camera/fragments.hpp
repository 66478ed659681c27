// SPDX-License-Identifier: MIT
#pragma once

// What a pixel of a gathered picture sees: its rays, sorted into pieces of surfaces that are lit once each (gather_picture.hpp).

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// What the rays of one pixel meet of one surface, facing one way.
struct Fragment {
  std::uint32_t x = 0, y = 0;
  float share = 0.0f;  // of the pixel
  FinalGather::Place place;
  glm::dvec3 positions{0.0}, normals{0.0};  // sums over its rays
};

// The width of a pixel at the distance of a point.
struct PixelSize {
  glm::dvec3 eye{0.0};
  double angle = 0.0;
  [[nodiscard]] double operator()(const glm::dvec3& p) const { return angle * glm::length(p - eye); }
};

// Seen through one pixel, do these two belong together? Not where one part of a surface hides another, or on two sides of a crease.
[[nodiscard]] bool one_piece(const FinalGather::Place& a, const FinalGather::Place& b, const PixelSize& pixel_size);

// Adds the fragments of the pixel (x, y), given what each of its rays sees.
void add_fragments(const FinalGather& light, std::uint32_t x, std::uint32_t y, std::span<const std::optional<FinalGather::Place>> seen,
                   const PixelSize& pixel_size, std::vector<Fragment>& out);

inline constexpr std::uint32_t block_side = 8;  // pixels

// Adds to the irradiance of the fragments `own`, all of one block and one surface, what comes from the lamps. Where the surface
// fills the block, most pixels take their share of a lamp from their neighbours: all, where those see the whole lamp or nothing of it; else
// where they agree. The shadow of a thin thing can pass between them if the lamp is narrow, for then it is as thin; so a narrow lamp is
// looked for from all pixels at the border of the block, which a shadow of some length crosses, and if those differ, from every pixel.
void add_direct_light(const FinalGather& light, std::span<const std::uint32_t> own, const std::vector<Fragment>& fragments,
                      std::vector<Color>& irradiance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/fragments.cpp>
#endif
