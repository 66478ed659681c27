// SPDX-License-Identifier: MIT
#pragma once

// PNG, by stb_image_write: 8 bits a channel, sRGB. Values between two levels are dithered, so that a wall that darkens slowly shows no
// bands: in each pixel by a threshold that depends on its place alone (interleaved gradient noise, Jimenez 2014). A tEXt chunk "Exposure"
// tells by what factor radiance became brightness.

#include <cstdint>
#include <string>
#include <vector>

#include "apps/color.hpp"
#include "apps/picture.hpp"

namespace apps {

// What a PNG shows: 3 bytes a pixel, rows from the top.
[[nodiscard]] std::vector<std::uint8_t> dithered(const Picture& picture);

// The bytes of the file; empty when memory ran out. `tone`: by which the picture was shown.
[[nodiscard]] std::string to_png(const Picture& picture, const Tone& tone = {});

}  // namespace apps
