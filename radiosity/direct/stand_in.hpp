// SPDX-License-Identifier: MIT
#pragma once

// Triangle meshes that stand in for curved objects with which the intersection of a segment is slow to compute.

#include <cstdint>
#include <memory>
#include <vector>

#include <raycast/objects/mesh.hpp>
#include <raycast/transform.hpp>

namespace radiosity {

struct StandIn {
  std::shared_ptr<const raycast::Mesh> mesh;
  std::vector<std::uint32_t> sheets;  // by face of the mesh: sheet of the object
};

// Approximates the object within `tolerance` (a length) by two open meshes, so that each crossing of a segment counts by itself, without
// entry and exit; empty if they cannot be made.
[[nodiscard]] std::vector<StandIn> open_meshes(const raycast::PlacedObject& object, double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/stand_in.cpp>
#endif
