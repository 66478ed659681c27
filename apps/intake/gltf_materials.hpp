// SPDX-License-Identifier: MIT
#pragma once

// Materials of glTF: the base colour is the reflectance, the emissive colour (times KHR_materials_emissive_strength) a radiance L, so that
// the exitance is pi L. Of pictures the mean colour counts, times the factor.

#include <vector>

#include "apps/intake/gltf_data.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake {

// In the order of the file.
[[nodiscard]] std::vector<ModelMaterial> read_gltf_materials(const JsonValue& root, GltfData& data, Notes& notes);

}  // namespace apps::intake
