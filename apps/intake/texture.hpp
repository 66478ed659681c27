// SPDX-License-Identifier: MIT
#pragma once

// Pictures on surfaces. A radiosity solver needs their mean, over all of them or over the part that lies on a polygon.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <radiosity/scene/material.hpp>

namespace apps::intake {

// At most 256 x 256 pixels, in linear light; of larger ones each pixel is the mean of a block. Each counts as far as it is opaque.
class Picture {
 public:
  // Of a PNG or JPEG file. Null when it cannot be read, has more than 2^26 pixels, or lets all light through.
  [[nodiscard]] static std::shared_ptr<const Picture> read(std::string_view bytes);
  // Of rows of pixels of four bytes each: red, green, blue in sRGB, and how opaque. Null when there are none, or they let all light
  // through.
  [[nodiscard]] static std::shared_ptr<const Picture> of_pixels(std::uint32_t width, std::span<const std::uint8_t> rgba);

  [[nodiscard]] const radiosity::Color& mean() const { return mean_; }

  struct Part {
    radiosity::Color mean{0.0};
    double variance = 0.0;  // within it: the mean squared distance from its mean
  };
  // What lies on a triangle with these texture coordinates: (0, 0) is the first corner of the first row, (1, 1) the last of the last one,
  // beyond which the picture repeats. Taken at 16 points. The mean of all where it is transparent.
  [[nodiscard]] Part on_triangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const;

 private:
  [[nodiscard]] const glm::vec4& at(glm::dvec2 place) const;

  std::uint32_t width_ = 0, height_ = 0;
  std::vector<glm::vec4> pixels_;  // the colour times how opaque it is, and that
  radiosity::Color mean_{0.0};
};

// The pictures of a file: each is read once.
template <class Key>
class Pictures {
 public:
  // What read() gives, a picture or null, when it is asked for the first time.
  template <class Read>
  [[nodiscard]] const std::shared_ptr<const Picture>& of(const Key& picture, const Read& read) {
    const auto [known, is_new] = known_.try_emplace(picture);
    if (is_new) { known->second = read(); }
    return known->second;
  }

 private:
  std::map<Key, std::shared_ptr<const Picture>> known_;
};

}  // namespace apps::intake
