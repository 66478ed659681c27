// SPDX-License-Identifier: MIT
#pragma once

// A picture as the bytes of a file.
//
//   .png  what is shown: 8 bits a channel, sRGB, by stb_image_write. Values between two levels are dithered, so that a wall that darkens
//         slowly shows no bands: in each pixel by a threshold that depends on its place alone (interleaved gradient noise, Jimenez 2014).
//         A tEXt chunk "Exposure" tells by what factor radiance became brightness.
//   .hdr  radiance, W/m2/sr, linear, without exposure: Radiance RGBE (Ward 1991); exact to 1 % of the largest channel.
//   .pfm  the same in single precision: portable float map, little-endian, rows from the bottom. The format has no place for comments.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/color.hpp"
#include "apps/picture.hpp"

namespace apps {

enum class PictureFormat { png, hdr, pfm };

// By the ending of the name.
[[nodiscard]] std::optional<PictureFormat> picture_format(const std::string& path);

// What a PNG shows: 3 bytes a pixel, rows from the top.
[[nodiscard]] std::vector<std::uint8_t> dithered(const Picture& picture);

// Empty when memory ran out. `tone` is that of the picture; it says nothing about radiance.
[[nodiscard]] std::string to_bytes(const Picture& picture, PictureFormat format, const Tone& tone);
[[nodiscard]] std::string to_png(const Picture& picture, const Tone& tone = {});

}  // namespace apps
