// SPDX-License-Identifier: MIT
#pragma once

// Where two surfaces lie in one plane, such as a lamp and the ceiling that it is set into, a viewer of meshes finds both at the same depth
// and shows now the one and now the other. Every file of a mesh is therefore written from one whose places have moved a little apart.

#include <cstdint>

#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>

#include "apps/scene_file.hpp"

namespace apps {

// Does another object cover the leaf, or a part of it? Where both lie in one plane the leaf must not show through.
[[nodiscard]] bool is_covered(const radiosity::Solution& solution, std::uint32_t node);

// A mesh of the solution with the same faces and corners: corners that only covered leaves have lie a little behind their places, lamps in
// the plane of a ceiling a little before theirs. The distance is 1e-4 of the scene's diameter.
[[nodiscard]] radiosity::Mesh in_depth_order(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh);

}  // namespace apps
