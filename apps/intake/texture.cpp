// SPDX-License-Identifier: MIT
#include "apps/intake/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/tone.hpp>

#include "apps/gzip.hpp"

#if defined(__clang__)  // stb_image shifts negative numbers
#pragma clang attribute push(__attribute__((no_sanitize("undefined"))), apply_to = function)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif

namespace apps {

bool inflate(std::string_view stream, std::span<char> out) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (stream.size() > most || out.size() > most) { return false; }
  const int size = static_cast<int>(out.size());
  return stbi_zlib_decode_noheader_buffer(out.data(), size, stream.data(), static_cast<int>(stream.size())) == size;
}

}  // namespace apps

namespace apps::intake {

std::shared_ptr<const Picture> Picture::read(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) { return nullptr; }
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) { return nullptr; }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > most_pixels) { return nullptr; }
  const std::unique_ptr<stbi_uc, void (*)(void*)> image(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  return image ? of_pixels(static_cast<std::uint32_t>(width), {image.get(), 4 * pixels}) : nullptr;
}

std::shared_ptr<const Picture> Picture::of_pixels(std::uint32_t width, std::span<const std::uint8_t> rgba) {
  constexpr std::uint32_t most_side = 256;
  const auto height = static_cast<std::uint32_t>(width == 0 ? 0 : rgba.size() / 4 / width);
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    linear[i] = static_cast<float>(radiosity::srgb_decode(static_cast<double>(i) / 255.0));
  }
  auto picture = std::make_shared<Picture>();
  picture->width_ = std::min(width, most_side);
  picture->height_ = std::min(height, most_side);
  picture->pixels_.resize(std::size_t{picture->width_} * picture->height_);
  glm::dvec4 sum(0.0);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::size_t row = std::size_t{y} * picture->height_ / height * picture->width_;
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint8_t* const p = &rgba[4 * (std::size_t{y} * width + x)];
      const float opaque = static_cast<float>(p[3]) / 255.0F;
      const glm::vec4 pixel(opaque * linear[p[0]], opaque * linear[p[1]], opaque * linear[p[2]], opaque);
      picture->pixels_[row + std::size_t{x} * picture->width_ / width] += pixel;
      sum += glm::dvec4(pixel);
      picture->most_opaque_ = std::max(picture->most_opaque_, static_cast<double>(p[3]) / 255.0);
    }
  }
  if (!(sum.w > 0.0)) { return nullptr; }
  picture->mean_ = radiosity::Color(sum) / sum.w;
  return picture;
}

const glm::vec4& Picture::at(glm::dvec2 place) const {
  const auto index = [](double t, std::uint32_t n) {
    const double within = t - std::floor(t);  // NaN if t is not finite
    return within >= 0.0 && within < 1.0 ? static_cast<std::size_t>(within * n) : 0;
  };
  return pixels_[index(place.y, height_) * width_ + index(place.x, width_)];
}

Picture::Part Picture::on_triangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const {
  constexpr int rows = 4;  // rows of small triangles, at whose centres the picture is sampled
  glm::dvec4 sum(0.0);
  double squares = 0.0;
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < 2 * i + 1; ++k) {
      // The small triangle k of row i points up (even k) or down.
      const double down = k % 2 == 0 ? 2.0 / 3.0 : 1.0 / 3.0;
      const double v = (i + down) / rows;                                      // from a towards the side bc
      const double w = (k / 2 + (k % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0)) / rows;  // parallel to this side, at most v
      const glm::dvec4 pixel(at(a + (v - w) * (b - a) + w * (c - a)));
      sum += pixel;
      if (pixel.w > 0.0) { squares += glm::dot(radiosity::Color(pixel), radiosity::Color(pixel)) / pixel.w; }
    }
  }
  if (!(sum.w > 0.0)) { return {mean_, 0.0}; }
  const radiosity::Color mean = radiosity::Color(sum) / sum.w;
  return {mean, std::max(0.0, squares / sum.w - glm::dot(mean, mean))};
}

}  // namespace apps::intake
