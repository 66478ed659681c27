// SPDX-License-Identifier: MIT
#include "apps/png.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "apps/text.hpp"

namespace apps {
namespace {

// A threshold between 0 and 1 for the pixel. It keeps off both ends, so that values that are a level, but for rounding, stay that level.
double threshold(std::uint32_t x, std::uint32_t y) {
  const auto fraction = [](double value) { return value - std::floor(value); };
  return 0.001 + 0.998 * fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
}

// ISO 3309, as PNG has it; bit by bit, for a few bytes.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int k = 0; k < 8; ++k) { crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u))); }
  }
  return ~crc;
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

std::vector<std::uint8_t> dithered(const Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * picture.shown.size());
  for (std::size_t i = 0; i < picture.shown.size(); ++i) {
    const double raise = threshold(static_cast<std::uint32_t>(i % picture.width), static_cast<std::uint32_t>(i / picture.width));
    for (int c = 0; c < 3; ++c) {
      bytes.push_back(static_cast<std::uint8_t>(std::floor(255.0 * srgb_encode(double{picture.shown[i][c]}) + raise)));
    }
  }
  return bytes;
}

std::string to_png(const Picture& picture, const Tone& tone) {
  std::string bytes;
  const auto append = [](void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  if (stbi_write_png_to_func(append, &bytes, width, height, 3, dithered(picture).data(), 3 * width) == 0) { return {}; }
  constexpr std::size_t header = 8 + 25;  // the signature, and the chunk that comes first
  return bytes.insert(header, text_chunk("Exposure", formatted("%.6g", tone.exposure) + " per W/m2/sr, tone " + name(tone.curve)));
}

}  // namespace apps
