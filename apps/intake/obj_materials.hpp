// SPDX-License-Identifier: MIT
#pragma once

// MTL, the materials of OBJ files: Kd is the reflectance; Ke, the radiance that a surface sends out, becomes its exitance pi Ke. Textures
// are passed over: Kd stands for them. Nothing in such a file is an error: what cannot be read is noted, and the material keeps what it
// has.

#include <string>
#include <vector>

#include "apps/intake/model.hpp"

namespace apps::intake {

// Gives the materials of these names what the library says about them.
void read_obj_materials(const std::string& library, const SideFile& side_file, std::vector<ModelMaterial>& materials, Notes& notes);

}  // namespace apps::intake
