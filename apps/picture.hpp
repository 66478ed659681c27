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
  std::vector<glm::vec3> shown;       // linear values from 0 to 1, rows from the top
  std::vector<glm::dvec3> radiosity;  // mean over each pixel, W/m2: the same before exposure and clamping, however weak the light is
  std::vector<char> partly_lamp;      // 1 where the samples of a pixel are known to meet surfaces of different emission, else 0

  Picture(std::uint32_t width_, std::uint32_t height_)
      : width{width_}, height{height_}, shown(std::size_t{width_} * height_), radiosity(shown.size()), partly_lamp(shown.size(), 0) {}

  void set(std::size_t pixel, const radiosity::Color& shown_, const radiosity::Color& radiosity_) {
    shown[pixel] = glm::vec3(shown_);
    radiosity[pixel] = radiosity_;
  }
  [[nodiscard]] Rgb8 pixel(std::uint32_t x, std::uint32_t y) const { return to_rgb8(radiosity::Color(shown[std::size_t{y} * width + x])); }
};

// Draws the mesh; where there is none the picture is black. Nothing when `cancel` became true.
[[nodiscard]] std::optional<Picture> draw(const radiosity::Mesh& mesh, const View& view, const Tone& tone, unsigned samples = 4,
                                          const std::atomic<bool>* cancel = nullptr);

// The exposure that shows the 98th percentile of the luminance of what the view sees as 0.8 in linear light: lit walls are bright, and
// there is room above for what lies close to a lamp. Light that is emitted does not count. Where nothing is seen to reflect light, the
// brightest emission that is seen becomes 1; where nothing shines, 1. The light is that of the mesh, so that all methods agree.
[[nodiscard]] double automatic_exposure(const radiosity::Mesh& mesh, const radiosity::Scene& scene, const View& view);

}  // namespace apps
