// SPDX-License-Identifier: MIT
#include "apps/radiance_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace apps {
namespace {

std::vector<float> radiance(const Picture& picture) {
  std::vector<float> values;
  values.reserve(3 * picture.radiosity.size());
  for (const glm::dvec3& b : picture.radiosity) {
    for (int c = 0; c < 3; ++c) { values.push_back(static_cast<float>(b[c] * std::numbers::inv_pi)); }
  }
  return values;
}

}  // namespace

// Not compressed. Mantissas are scaled so that the largest is 128 or more, and no pixel looks like the beginning of a compressed row.
std::string to_hdr(const Picture& picture) {
  std::string bytes = "#?RADIANCE\n# linear radiance, W/m2/sr\nFORMAT=32-bit_rle_rgbe\n\n-Y ";
  bytes += std::to_string(picture.height) + " +X " + std::to_string(picture.width) + "\n";
  const std::vector<float> values = radiance(picture);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    int exponent = 0;
    const float largest = std::max({values[i], values[i + 1], values[i + 2]});
    std::frexp(largest, &exponent);
    const bool black = !(largest > 0.0f) || exponent < -127;
    for (std::size_t c = 0; c < 3; ++c) {
      const float mantissa = black ? 0.0f : std::ldexp(std::max(values[i + c], 0.0f), 8 - exponent);
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::min(mantissa, 255.0f)));
    }
    bytes += static_cast<char>(static_cast<std::uint8_t>(black ? 0 : std::min(exponent + 128, 255)));
  }
  return bytes;
}

std::string to_pfm(const Picture& picture) {
  static_assert(std::endian::native == std::endian::little, "the scale below says little-endian");
  const std::vector<float> values = radiance(picture);
  std::string bytes = "PF\n";
  bytes += std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
  const std::size_t row = 3 * std::size_t{picture.width};
  for (std::size_t y = picture.height; y-- > 0;) {
    bytes.append(reinterpret_cast<const char*>(values.data() + y * row), row * sizeof(float));
  }
  return bytes;
}

}  // namespace apps
