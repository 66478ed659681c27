// SPDX-License-Identifier: MIT
#pragma once

// A picture that is black all over, with what is to be seen instead of light.

#include <string>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/view.hpp>

#include "apps/scene_file.hpp"

namespace apps {

// A sentence that tells how much of the picture meets backs of surfaces, dark surfaces or nothing, and what to try. Empty where some pixel
// sees more than 1e-9 of the radiosity of the brightest lamp.
[[nodiscard]] std::string warning_of_dark_picture(const radiosity::Picture& picture, const SceneFile& file, const radiosity::View& view);

}  // namespace apps
