// SPDX-License-Identifier: MIT
#include "apps/picture_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "apps/bytes.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

// A threshold between 0 and 1 for the pixel. It avoids both ends, so that a value that equals a level up to rounding remains at this level.
double threshold(std::uint32_t x, std::uint32_t y) {
  const auto fraction = [](double value) { return value - std::floor(value); };
  return 0.001 + 0.998 * fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) { bytes += static_cast<char>(value >> shift & 0xff); }
  return bytes;
}

std::string text_chunk(std::string_view key, std::string_view text) {
  std::string body = "tEXt";
  body.append(key).append(1, '\0').append(text);
  return big_endian(static_cast<std::uint32_t>(body.size() - 4)) + body + big_endian(crc32(body));
}

}  // namespace

std::vector<std::uint8_t> dithered(const radiosity::Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * picture.shown.size());
  for (std::size_t i = 0; i < picture.shown.size(); ++i) {
    const double raise = threshold(static_cast<std::uint32_t>(i % picture.width), static_cast<std::uint32_t>(i / picture.width));
    for (int c = 0; c < 3; ++c) {
      bytes.push_back(static_cast<std::uint8_t>(std::floor(255.0 * radiosity::srgb_encode(double{picture.shown[i][c]}) + raise)));
    }
  }
  return bytes;
}

std::string to_png(const radiosity::Picture& picture, const radiosity::Tone& tone) {
  std::string bytes;
  const auto append = [](void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  if (stbi_write_png_to_func(append, &bytes, width, height, 3, dithered(picture).data(), 3 * width) == 0) { return {}; }
  constexpr std::size_t header = 8 + 25;  // the signature and the first chunk
  return bytes.insert(header, text_chunk("Exposure", formatted("%.6g", tone.exposure) + " per W/m2/sr, tone " + name(tone.curve)));
}

namespace {

std::vector<float> radiance(const radiosity::Picture& picture) {
  std::vector<float> values;
  values.reserve(3 * picture.radiosity.size());
  for (const glm::dvec3& b : picture.radiosity) {
    for (int c = 0; c < 3; ++c) { values.push_back(static_cast<float>(b[c] * std::numbers::inv_pi)); }
  }
  return values;
}

}  // namespace

// The rows are not compressed. Mantissas are scaled so that the largest is at least 128, so no pixel looks like the start of a compressed
// row.
std::string to_hdr(const radiosity::Picture& picture) {
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

std::string to_pfm(const radiosity::Picture& picture) {
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
