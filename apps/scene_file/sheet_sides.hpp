// SPDX-License-Identifier: MIT
#pragma once

// Meshes that list a sheet together with its back, on the same vertices. As one mesh they are no manifold, because an edge in the sheet has
// four faces, or they enclose nothing. With vertices of their own the two sides are two surfaces that lie back to back.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace apps::scene_file {

struct FaceLists {
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;  // indices into the positions
};

// Faces belong together when they share an edge across which they look the same way and which is no fold: of two faces folded flat onto
// each other one is the back of the other. Faces that belong together share vertices; others get copies. Every index must be in range.
[[nodiscard]] FaceLists with_sides_parted(const FaceLists& mesh);

}  // namespace apps::scene_file
