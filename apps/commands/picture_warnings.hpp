// SPDX-License-Identifier: MIT
#pragma once

// Warns of a picture that shows next to nothing, and says what to try.

#include <string>
#include <vector>

#include <radiosity/camera/picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/result/audit.hpp>

#include "apps/scene_file.hpp"

namespace apps {

// A sentence if no pixel sees any light (more than 1e-9 of the radiosity of the brightest lamp), if at least nine tenths of what the camera
// sees is black in the picture, or if the picture shows nothing but light less than a thousandth as bright as is usual in the scene. Else
// empty. `automatic`: the tone, if its exposure was not chosen by the user, else null. `surfaces`: of the solution.
[[nodiscard]] std::string warning_of_picture(const radiosity::Picture& picture, const SceneFile& file, const radiosity::View& view,
                                             const radiosity::Tone* automatic, const std::vector<radiosity::SurfaceMean>& surfaces);

}  // namespace apps
