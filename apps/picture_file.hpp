// SPDX-License-Identifier: MIT
#pragma once

// Writes pictures as files.
//
// PNG, by stb_image_write: 8 bits per channel, sRGB. Values between two levels are dithered, so that a smooth gradient on a wall shows no
// bands: each pixel has a threshold that depends on its position alone (interleaved gradient noise, Jimenez 2014). A tEXt chunk
// "Exposure" states the factor from radiance to brightness.
//
// For other programs: radiance in W/m2/sr, linear sRGB primaries, without exposure.
//   .hdr  Radiance RGBE (Ward 1991), exact to 1 % of the largest channel. A comment in the header states the unit.
//   .pfm  portable float map: single precision, little-endian, rows from the bottom. The format has no place for comments.

#include <cstdint>
#include <string>
#include <vector>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/tone.hpp>

namespace apps {

// The pixels of a PNG: 3 bytes per pixel, rows from the top.
[[nodiscard]] std::vector<std::uint8_t> dithered(const radiosity::Picture& picture);

// The bytes of the file; empty if memory was exhausted. `tone`: the one by which the picture was shown.
[[nodiscard]] std::string to_png(const radiosity::Picture& picture, const radiosity::Tone& tone = {});

[[nodiscard]] std::string to_hdr(const radiosity::Picture& picture);
[[nodiscard]] std::string to_pfm(const radiosity::Picture& picture);

}  // namespace apps
