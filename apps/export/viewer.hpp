// SPDX-License-Identifier: MIT
#pragma once

// A page that shows a solution in any browser with WebGL 2, from a file and offline: nothing is loaded from elsewhere. The light as it was
// computed, to be exposed and looked at from everywhere; the leaves and the levels of the hierarchy above them, as borders and as colours.

#include <string>

#include <radiosity/result/outcome.hpp>

#include "apps/scene_file.hpp"

namespace apps {

// `camera`: the one that the page begins with. `title` and `sentence` are plain text.
[[nodiscard]] std::string viewer_page(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Camera& camera,
                                      double exposure, const std::string& title, const std::string& sentence);

}  // namespace apps
