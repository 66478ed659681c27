// SPDX-License-Identifier: MIT
#include "apps/intake/texture.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#if defined(__clang__)  // it shifts negative numbers
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
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace apps::intake {

std::optional<radiosity::Color> mean_color(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) { return std::nullopt; }
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) { return std::nullopt; }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > most_pixels) { return std::nullopt; }
  const std::unique_ptr<stbi_uc, void (*)(void*)> image(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!image) { return std::nullopt; }
  std::array<double, 256> linear{};  // IEC 61966-2-1
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const double v = static_cast<double>(i) / 255.0;
    linear[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  radiosity::Color sum(0.0);
  double opaque = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const stbi_uc* const pixel = image.get() + 4 * i;
    const double alpha = pixel[3] / 255.0;
    sum += alpha * radiosity::Color(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]);
    opaque += alpha;
  }
  if (!(opaque > 0.0)) { return std::nullopt; }
  return sum / opaque;
}

}  // namespace apps::intake
