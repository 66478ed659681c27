// SPDX-License-Identifier: MIT
#pragma once

// Pieces of scene text that several tests put together.

#include <string>

namespace scene_texts {

inline const std::string grey = "material grey reflectance 0.5\n";
inline const std::string ball = "sphere ball center 0 0 0 radius 1 material grey\n";

}  // namespace scene_texts
