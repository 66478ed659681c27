// SPDX-License-Identifier: MIT
#pragma once

// Chooses the pixels of a picture that are compared with the truth, and their weights. If all were drawn uniformly, a few hundred bright
// pixels that hold nearly all of the energy and of the error might be missed, and the error would seem to be zero. So half of the pixels
// are spread uniformly over the picture, and half are drawn by an importance computed from the picture itself: where it is bright, and
// where it changes from pixel to pixel. A pixel is weighted with the inverse of the density of both halves together (Veach and Guibas
// 1995), which is at most twice the weight of a uniform draw. So places that the picture shows too dark are found as well as with half as
// many uniform pixels. Both halves are stratified: one pixel from each of equal shares of the picture, and of the importance.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

class PixelDraw {
 public:
  struct Pixel {
    std::uint32_t x = 0, y = 0;
    double weight = 1.0;  // the mean of a value over the picture is estimated by the mean of weight * value over the drawn pixels
  };

  // `importance`: of each pixel, row by row, finite and >= 0. If it is 0 everywhere, the draw is uniform.
  PixelDraw(std::uint32_t width, std::uint32_t height, std::vector<double> importance);

  // The number of strata along one side of the picture for at least `points` pixels; size(side) pixels are then drawn.
  [[nodiscard]] static std::uint32_t side(std::uint64_t points);
  [[nodiscard]] static std::size_t size(std::uint32_t side) { return std::size_t{2} * side * side; }

  // Pixel i of the size(side) pixels.
  [[nodiscard]] Pixel draw(std::size_t i, std::uint32_t side, Random& random) const;

 private:
  [[nodiscard]] Pixel weighed(std::uint32_t x, std::uint32_t y) const;

  std::uint32_t width_, height_;
  std::vector<double> importance_;    // relative to its mean
  std::vector<std::uint32_t> order_;  // pixels in a space-filling order: successive ones are near each other in the picture
  std::vector<double> until_;         // cumulative importance in this order, up to and including each pixel
};

// The importance of each pixel of a picture. Half of it is the square of the pixel's radiosity and half the mean square of the eight
// pixels around, because beside a bright pixel a dark one may be wrong; added is twice the mean squared difference from the four adjacent
// pixels. Pixels marked in `left_out` are not read.
[[nodiscard]] std::vector<double> pixel_importance(std::uint32_t width, std::uint32_t height, const std::vector<Color>& radiosity,
                                                   const std::vector<char>& left_out);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/pixel_draw.cpp>
#endif
