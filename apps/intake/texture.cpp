// SPDX-License-Identifier: MIT
#include "apps/intake/texture.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>

#include <radiosity/camera/tone.hpp>

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
  return mean_of_pixels({image.get(), 4 * pixels});
}

std::optional<radiosity::Color> mean_of_pixels(std::span<const std::uint8_t> rgba) {
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) { linear[i] = radiosity::srgb_decode(static_cast<double>(i) / 255.0); }
  radiosity::Color sum(0.0);
  double opaque = 0.0;
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    const double alpha = rgba[i + 3] / 255.0;
    sum += alpha * radiosity::Color(linear[rgba[i]], linear[rgba[i + 1]], linear[rgba[i + 2]]);
    opaque += alpha;
  }
  if (!(opaque > 0.0)) { return std::nullopt; }
  return sum / opaque;
}

}  // namespace apps::intake
