// SPDX-License-Identifier: MIT
#pragma once

// A picture as arrays of pixels (made by mesh_picture.hpp and gather_picture.hpp).

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/tone.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::vec3> shown;       // linear values in [0, 1] after exposure and clamping, rows from the top
  std::vector<glm::dvec3> radiosity;  // mean over each pixel, W/m2, before exposure and clamping
  std::vector<char> partly_lamp;      // 1 where the samples of a pixel met surfaces of different emission, else 0

  Picture(std::uint32_t width_, std::uint32_t height_)
      : width{width_}, height{height_}, shown(std::size_t{width_} * height_), radiosity(shown.size()), partly_lamp(shown.size(), 0) {}

  void set(std::size_t pixel, const Color& shown_, const Color& radiosity_) {
    shown[pixel] = glm::vec3(shown_);
    radiosity[pixel] = radiosity_;
  }
  [[nodiscard]] Rgb8 pixel(std::uint32_t x, std::uint32_t y) const { return to_rgb8(Color(shown[std::size_t{y} * width + x])); }
};

}  // namespace radiosity
