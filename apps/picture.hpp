// SPDX-License-Identifier: MIT
#pragma once

// The picture: the triangles of the solution's mesh, Gouraud-shaded from their half-edge colours (paper 4.5), drawn by
// an own z-buffer. No light is computed here; a picture of another view costs nothing but this.
//
//   coverage  Every pixel has samples x samples sample points on a regular grid. Vertices are snapped to 1/4096 of their
//             distance and edge functions are integers with a top-left rule: triangles that share an edge leave no gap
//             and cover no sample twice. Back faces are not drawn, so one looks into a room from outside.
//   depth     1/z is evaluated from the plane of the triangle in view space, not interpolated, so coplanar surfaces of
//             different triangulation agree to rounding; within 1e-7 the later input surface wins (a lamp in a ceiling).
//   colour    Radiosity is linear over the triangle in space (perspective-correct). Each sample is exposed and clamped
//             to [0,1], then the samples of a pixel are averaged in linear light, then encoded: the edge of a lamp that
//             is a hundred times too bright stays as smooth as any other.

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/color.hpp"
#include "apps/view.hpp"

namespace apps {

struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;     // 3 bytes a pixel, rows from the top
  std::vector<glm::vec3> radiosity;  // mean over each pixel, W/m2: the same before exposure and clamping

  [[nodiscard]] Rgb8 pixel(std::uint32_t x, std::uint32_t y) const {
    const std::size_t at = 3 * (std::size_t{y} * width + x);
    return {rgb[at], rgb[at + 1], rgb[at + 2]};
  }
};

// Draws the mesh; where there is none the picture is black. Nothing when `cancel` became true.
[[nodiscard]] std::optional<Picture> draw(const radiosity::Mesh& mesh, const View& view, double exposure, unsigned samples = 4,
                                          const std::atomic<bool>* cancel = nullptr);

// The exposure that shows the 98th percentile (by area) of the reflected radiosity, largest channel, as 0.65 in linear
// light: lit walls are bright, and there is room above for what lies close to a lamp. Where nothing reflects, the
// brightest emission becomes 1; where nothing shines, 1. Depends on the solution alone, not on the view.
[[nodiscard]] double automatic_exposure(const radiosity::Mesh& mesh, const radiosity::Scene& scene);

}  // namespace apps
