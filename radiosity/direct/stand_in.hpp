// SPDX-License-Identifier: MIT
#pragma once

// Triangle meshes that stand in for curved objects whose meeting with a segment takes long to compute.

#include <cstdint>
#include <memory>
#include <vector>

#include <raycast/objects/mesh.hpp>
#include <raycast/transform.hpp>

namespace radiosity {

struct StandIn {
  std::shared_ptr<const raycast::Mesh> mesh;
  std::vector<std::uint32_t> sheets;  // of the object, by face of the mesh
};

// The object to a tolerance (a length) as two meshes that are open, so that each crossing of a segment decides by itself; none when they
// make none.
[[nodiscard]] std::vector<StandIn> open_meshes(const raycast::PlacedObject& object, double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/stand_in.cpp>
#endif
