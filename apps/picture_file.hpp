// SPDX-License-Identifier: MIT
#pragma once

// Pictures as files.
//
// PNG, by stb_image_write: 8 bits a channel, sRGB. Values between two levels are dithered, so that a wall that darkens slowly shows no
// bands: in each pixel by a threshold that depends on its place alone (interleaved gradient noise, Jimenez 2014). A tEXt chunk "Exposure"
// tells by what factor radiance became brightness.
//
// For other programs: radiance, W/m2/sr, linear sRGB primaries, without exposure.
//   .hdr  Radiance RGBE (Ward 1991), exact to 1 % of the largest channel. A comment in the header states the unit.
//   .pfm  portable float map: single precision, little-endian, rows from the bottom. The format has no place for comments.

#include <cstdint>
#include <string>
#include <vector>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/tone.hpp>

namespace apps {

// What a PNG shows: 3 bytes a pixel, rows from the top.
[[nodiscard]] std::vector<std::uint8_t> dithered(const radiosity::Picture& picture);

// The bytes of the file; empty when memory ran out. `tone`: by which the picture was shown.
[[nodiscard]] std::string to_png(const radiosity::Picture& picture, const radiosity::Tone& tone = {});

[[nodiscard]] std::string to_hdr(const radiosity::Picture& picture);
[[nodiscard]] std::string to_pfm(const radiosity::Picture& picture);

}  // namespace apps
