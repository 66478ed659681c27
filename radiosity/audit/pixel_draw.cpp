// SPDX-License-Identifier: MIT
#include <radiosity/audit/pixel_draw.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

HALFLIGHT_INLINE PixelDraw::PixelDraw(std::uint32_t width, std::uint32_t height, std::vector<double> importance)
    : width_{width}, height_{height}, importance_{std::move(importance)} {
  double sum = 0.0;
  for (const double i : importance_) { sum += i; }
  const double mean = sum / static_cast<double>(importance_.size());
  for (double& i : importance_) { i = sum > 0.0 ? i / mean : 1.0; }
  constexpr std::uint32_t square = 16;
  order_.reserve(importance_.size());
  for (std::uint32_t top = 0; top < height; top += square) {
    for (std::uint32_t left = 0; left < width; left += square) {
      for (std::uint32_t y = top; y < std::min(height, top + square); ++y) {
        for (std::uint32_t x = left; x < std::min(width, left + square); ++x) { order_.push_back(y * width + x); }
      }
    }
  }
  double before = 0.0;
  until_.reserve(order_.size());
  for (const std::uint32_t p : order_) { until_.push_back(before += importance_[p]); }
}

HALFLIGHT_INLINE std::uint32_t PixelDraw::side(std::uint64_t points) {
  return static_cast<std::uint32_t>(std::ceil(std::sqrt(0.5 * static_cast<double>(points))));
}

HALFLIGHT_INLINE PixelDraw::Pixel PixelDraw::draw(std::size_t i, std::uint32_t side, Random& random) const {
  const std::size_t strata = std::size_t{side} * side;
  if (i < strata) {
    const auto place = [&](std::size_t cell, std::uint32_t pixels) {
      const double at = (static_cast<double>(cell) + random.uniform()) / side * pixels;
      return std::min(static_cast<std::uint32_t>(at), pixels - 1);
    };
    const std::uint32_t x = place(i % side, width_);
    return weighed(x, place(i / side, height_));
  }
  const double at = (static_cast<double>(i - strata) + random.uniform()) / static_cast<double>(strata) * until_.back();
  const std::size_t index = drawn_index(until_, at);
  return weighed(order_[index] % width_, order_[index] / width_);
}

HALFLIGHT_INLINE PixelDraw::Pixel PixelDraw::weighed(std::uint32_t x, std::uint32_t y) const {
  return {x, y, 1.0 / (0.5 + 0.5 * importance_[std::size_t{y} * width_ + x])};
}

HALFLIGHT_INLINE std::vector<double> pixel_importance(std::uint32_t width, std::uint32_t height, const std::vector<Color>& radiosity,
                                                      const std::vector<char>& left_out) {
  std::vector<double> result(radiosity.size(), 0.0);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t own = std::size_t{y} * width + x;
      if (left_out[own] != 0) { continue; }
      double light = 0.0, contrast = 0.0, around = 0.0, beside = 0.0;
      for (std::uint32_t v = y > 0 ? y - 1 : 0; v < std::min(height, y + 2); ++v) {
        for (std::uint32_t u = x > 0 ? x - 1 : 0; u < std::min(width, x + 2); ++u) {
          const std::size_t other = std::size_t{v} * width + u;
          if (other == own || left_out[other] != 0) { continue; }
          light += glm::dot(radiosity[other], radiosity[other]);
          around += 1.0;
          if (u != x && v != y) { continue; }
          const Color step = radiosity[other] - radiosity[own];
          contrast += glm::dot(step, step);
          beside += 1.0;
        }
      }
      result[own] = glm::dot(radiosity[own], radiosity[own]);
      if (around > 0.0) { result[own] = 0.5 * (result[own] + light / around); }
      if (beside > 0.0) { result[own] += 2.0 * contrast / beside; }
      if (!std::isfinite(result[own])) { result[own] = 0.0; }
    }
  }
  return result;
}

}  // namespace radiosity
