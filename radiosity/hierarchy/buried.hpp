// SPDX-License-Identifier: MIT
#pragma once

// Finds input faces that are completely hidden, before any pair of faces is considered: of a thousand boxes at the same place, 999 are
// covered by the last one; of nested boxes all but the outermost are in the dark. Otherwise refinement would split them all against each
// other, because they are so close, and find only afterwards that they are not exposed (exposure.hpp).
//
// Only proven cases count (in the sense of raycast::Scene::covered): a face is buried if a later object is the same surface at the same
// place, or if a convex solid contains its corners and everything within the distance by which finer patches can bulge, deeper than the
// tolerance of occlusion. All other faces are treated as visible, for instance those of a curved solid inside another one with a gap
// narrower than its patches can bulge.

#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// By node: is this input face proven to be buried, or does this cluster contain only such faces? Time: n log n; among solids that contain
// each other, up to 256 solids a face.
[[nodiscard]] std::vector<bool> buried_nodes(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/buried.cpp>
#endif
