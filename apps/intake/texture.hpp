// SPDX-License-Identifier: MIT
#pragma once

// Pictures on surfaces. The radiosity solver only needs their mean, over the whole picture or over the part on a polygon.

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

// At most 256 x 256 pixels, in linear light; in larger pictures each pixel is the mean of a block. Pixels are weighted by their opacity.
class Picture {
 public:
  // Decodes a PNG or JPEG file. Null if it is invalid, has more than 2^26 pixels, or is completely transparent.
  [[nodiscard]] static std::shared_ptr<const Picture> read(std::string_view bytes);
  // From rows of pixels of four bytes each: red, green, blue in sRGB, and opacity. Null if there are none or all are transparent.
  [[nodiscard]] static std::shared_ptr<const Picture> of_pixels(std::uint32_t width, std::span<const std::uint8_t> rgba);

  [[nodiscard]] const radiosity::Color& mean() const { return mean_; }
  // The opacity of the most opaque pixel.
  [[nodiscard]] double most_opaque() const { return most_opaque_; }

  struct Part {
    radiosity::Color mean{0.0};
    double variance = 0.0;  // within the part: the mean squared distance from its mean
    bool dark = false;      // no pixel has more than a thousandth of the brightest one of the picture, as black stored as JPEG
  };
  // The part on a triangle with these texture coordinates: (0, 0) is the start of the first row, (1, 1) the end of the last row; the
  // picture is repeated beyond. The triangle is cut into strips along the rows of pixels, at least 64, and each counts with the pixels
  // along its middle. The whole picture, if it is transparent there, or repeated more than 16 times from top to bottom.
  [[nodiscard]] Part on_triangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const;

 private:
  // Sums over pixels.
  struct Sums {
    glm::dvec4 color{0.0};  // times the opacity, and the opacity
    double squares = 0.0;   // of the colours, times the opacity
    double bright = 0.0;    // the number of pixels that are not dark
    void add(const Sums& other, double times);
    [[nodiscard]] Part part() const;  // the opacity must be positive
  };
  void sum_rows();
  [[nodiscard]] Sums pixel(std::size_t index) const;
  // Over a row from x = 0 to x, both in pixels; the row is repeated beyond its ends.
  [[nodiscard]] Sums along_row(std::size_t row, double x) const;

  std::uint32_t width_ = 0, height_ = 0;
  std::vector<glm::vec4> pixels_;  // the colour times the opacity, and the opacity
  float dark_ = 0.0F;              // the largest channel of a dark pixel
  std::vector<Sums> before_;       // over the pixels before each in its row, and over the row: width_ + 1 for each row
  Part whole_;
  radiosity::Color mean_{0.0};
  double most_opaque_ = 0.0;
};

// The pictures of a file, each read only once.
template <class Key>
class Pictures {
 public:
  // The picture or null returned by read(), which is called only at the first request.
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
