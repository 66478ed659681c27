// SPDX-License-Identifier: MIT
#pragma once

// Pictures on surfaces: a radiosity solver needs their mean.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include <radiosity/scene/material.hpp>

namespace apps::intake {

// The mean of a PNG or JPEG file in linear light, each pixel weighted by how opaque it is. Nothing when it cannot be read, has more than
// 2^26 pixels, or lets all light through.
[[nodiscard]] std::optional<radiosity::Color> mean_color(std::string_view bytes);

// The same of pixels of four bytes each: red, green, blue in sRGB, and how opaque.
[[nodiscard]] std::optional<radiosity::Color> mean_of_pixels(std::span<const std::uint8_t> rgba);

// The mean colours of the pictures of a file: each picture is read once.
template <class Key>
class PictureMeans {
 public:
  // What read() gives, a colour or nothing, when the picture is asked for the first time.
  template <class Read>
  [[nodiscard]] const std::optional<radiosity::Color>& of(const Key& picture, const Read& read) {
    const auto [known, is_new] = means_.try_emplace(picture);
    if (is_new) { known->second = read(); }
    return known->second;
  }

 private:
  std::map<Key, std::optional<radiosity::Color>> means_;
};

}  // namespace apps::intake
