// SPDX-License-Identifier: MIT
#pragma once

// The parts of a run's scene that form factors, visibility and exposure read.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

class Patches;

// The references must outlive this. The hierarchy may grow, and surfaces and patches with it.
struct SceneView {
  const raycast::Scene& objects;  // in the frame
  const Plan& plan;
  const std::vector<Surface>& surfaces;  // boundary of each object
  const Hierarchy& hierarchy;            // over the faces of the boundaries
  const Patches& patches;                // by node

  // The sheet of its object to which a node belongs; not for clusters.
  [[nodiscard]] std::uint32_t sheet(std::size_t i) const { return hierarchy[i].surface - surfaces[hierarchy[i].object].first_surface; }
};

}  // namespace radiosity
