// SPDX-License-Identifier: MIT
#pragma once

// Which pixels of a picture are compared with the truth, and what each counts. Were all drawn evenly, a few hundred bright pixels that hold
// nearly all of the energy and of the error might be missed altogether, and the error would seem to be nothing. So half of the pixels are
// spread evenly over the picture, and half are drawn by an importance that the picture itself tells: where it is bright, and where it
// changes from pixel to pixel. A pixel counts with the inverse of the density of both together (Veach and Guibas 1995), which is at most
// twice as much as if all were drawn evenly: what the picture leaves dark wrongly is found as well as half as many even pixels find it.
// Both halves are stratified: one pixel in each of equal shares of the picture, and of the importance.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

class PixelDraw {
 public:
  struct Pixel {
    std::uint32_t x = 0, y = 0;
    double weight = 1.0;  // mean value over the picture = mean of weight * value over the pixels that are drawn
  };

  // `importance`: of each pixel, row by row, >= 0 and finite. Where it is 0 everywhere, all pixels count alike.
  PixelDraw(std::uint32_t width, std::uint32_t height, std::vector<double> importance);

  // For at least `points` pixels: the number of strata along one side of the picture. size(side) pixels are drawn then.
  [[nodiscard]] static std::uint32_t side(std::uint64_t points);
  [[nodiscard]] static std::size_t size(std::uint32_t side) { return std::size_t{2} * side * side; }

  // Pixel i of size(side).
  [[nodiscard]] Pixel draw(std::size_t i, std::uint32_t side, Random& random) const;

 private:
  [[nodiscard]] Pixel weighed(std::uint32_t x, std::uint32_t y) const;

  std::uint32_t width_, height_;
  std::vector<double> importance_;    // relative to its mean
  std::vector<std::uint32_t> order_;  // pixels, square by square, so that neighbours in it are neighbours in the picture
  std::vector<double> until_;         // of each in this order: the importance of it and all before
};

// The importance of each pixel of a picture: the square of its radiosity and the mean of it over the eight pixels around, half of each, for
// beside a bright pixel a dark one may be wrong; and twice the mean square of what it differs from the four beside it. Of pixels that
// `left_out` names none is read.
[[nodiscard]] std::vector<double> pixel_importance(std::uint32_t width, std::uint32_t height, const std::vector<Color>& radiosity,
                                                   const std::vector<char>& left_out);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/pixel_draw.cpp>
#endif
