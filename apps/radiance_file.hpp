// SPDX-License-Identifier: MIT
#pragma once

// The light of a picture as a file for other programs: radiance, W/m2/sr, linear sRGB primaries, without exposure.
//
//   .hdr  Radiance RGBE (Ward 1991), exact to 1 % of the largest channel. A comment in the header states the unit.
//   .pfm  portable float map: single precision, little-endian, rows from the bottom. The format has no place for comments.

#include <string>

#include "apps/picture.hpp"

namespace apps {

[[nodiscard]] std::string to_hdr(const Picture& picture);
[[nodiscard]] std::string to_pfm(const Picture& picture);

}  // namespace apps
