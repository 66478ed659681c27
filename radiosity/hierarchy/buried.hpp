// SPDX-License-Identifier: MIT
#pragma once

// Input faces of which nothing can be seen, found before any pair of faces is looked at: of a thousand boxes at one place 999 are covered
// by the last, of nested boxes all but the outermost are in the dark. Refinement would split them all against each other, as near as they
// are, and only then find that nothing of them is exposed (exposure.hpp).
//
// Proven, in the sense of raycast::Scene::covered: a face is buried when a later object is the same surface at the same place, or when a
// convex solid holds its corners, and all that finer patches can bulge, deeper than the tolerance of occlusion. Faces for which neither is
// found are treated as visible, such as those of a curved solid that lies in another one with a gap narrower than its patches can bulge.

#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Which input faces are proven to be buried, and which clusters have no other; by node. Time: n log n, and, among solids that hold each
// other, up to 256 solids a face.
[[nodiscard]] std::vector<bool> buried_nodes(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/buried.cpp>
#endif
