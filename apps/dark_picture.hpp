// SPDX-License-Identifier: MIT
#pragma once

// A picture that is black all over, with what is to be seen instead of light.

#include <string>

#include "apps/picture.hpp"
#include "apps/scene_file.hpp"
#include "apps/view.hpp"

namespace apps {

// A sentence that tells how much of the picture meets backs of surfaces, dark surfaces or nothing, and what to try. Empty where some pixel
// sees more than 1e-9 of the radiosity of the brightest lamp.
[[nodiscard]] std::string warning_of_dark_picture(const Picture& picture, const SceneFile& file, const View& view);

}  // namespace apps
