// SPDX-License-Identifier: MIT
#pragma once

// A solid of a model that encloses all else, such as a box or a sphere as a sky. As a solid it would bury everything, and beside one that
// is thousands of times as large the rest would be lost in rounding.

#include <string>

#include "apps/intake/model.hpp"
#include "apps/intake/panes.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// If one of the analytic objects encloses all other surfaces but panes, and all cameras and lights but suns, makes it be seen from within,
// as a sky or a room is. If it is much larger than the rest and does not shine, it sends hardly any light back, and is left out. If it
// shines and is thousands of times as large, it is made smaller around the rest, where it looks the same. The result: a sentence that says
// so; empty: nothing was changed. `file`: has the materials and the cameras.
[[nodiscard]] std::string take_enclosure(Model& model, const Panes& panes, const SceneFile& file);

}  // namespace apps
