// SPDX-License-Identifier: MIT
#pragma once

// The materials of a model of another program as those of a scene. What the file leaves undefined, or gives as no diffuse surface can be,
// is chosen and told: reflectances that are missing or too large, mirrors, and which materials are lamps.

#include <string>
#include <string_view>
#include <vector>

#include <radiosity/scene/material.hpp>

#include "apps/intake/model.hpp"
#include "apps/intake/to_scene.hpp"

namespace apps {

// The materials in the order of the model, with the lamps of the options. If there are none, and nothing in the model shines,
// `lamps_by_name` makes those shine whose names say so. A lamp of the options that is no material of the model is a fault.
[[nodiscard]] std::vector<radiosity::Material> scene_materials(const Model& model, const ModelOptions& options, bool lamps_by_name,
                                                               std::vector<std::string>& notes, std::vector<std::string>& faults);

// The names of the materials, each once, at most 1000.
[[nodiscard]] std::vector<std::string_view> names_of(const std::vector<radiosity::Material>& materials);

}  // namespace apps
