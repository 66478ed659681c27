// SPDX-License-Identifier: MIT
#pragma once

// The exposed area of every node: the part of a patch that is not buried under another object. A floor under a box or a ceiling
// behind a lamp neither receives nor sends light. Without this the cells at the foot of a box would come out dark, because they
// would average the light over hidden ground.
//
// Invariant: the area of an inner node is the sum of the areas of its children, bit by bit.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

struct Exposure {
  std::vector<double> area;             // exposed area by node, in the frame
  std::vector<double> whole;            // the same including buried parts
  std::vector<glm::dvec3> centroid;     // centroid of the exposed area by node: area-weighted mean over its leaves
  std::vector<bool> partly_buried;      // is some but not all of the node hidden?
  std::vector<ExposedPoints> drawn;     // exposed points of nodes that are, or were, partly buried
  std::vector<std::uint32_t> drawn_of;  // by node: index of its points in `drawn`, or no_node
  bool all_buried = false;
  std::uint32_t buried_leaves = 0;  // number of leaves without exposed area

  // Exposed points of a partly buried node; null for other nodes, and if so little is exposed that no point was found.
  [[nodiscard]] const ExposedPoints* points(std::size_t i) const {
    return partly_buried[i] && drawn_of[i] != no_node && drawn[drawn_of[i]].count() > 0 ? &drawn[drawn_of[i]] : nullptr;
  }
};

// One end of a pair of patches. Without `exposure` all of it counts as exposed.
[[nodiscard]] PatchEnd patch_end(const SceneView& scene, const Exposure* exposure, std::uint32_t i);

// Measures those leaves that are new since the last call, and sums up the areas. Leaves near other objects are measured with 16
// stratified points, and 256 if these disagree: the standard error of the area is at most 1/32 of a leaf at the border of the hidden
// part. Requires the patches of all nodes.
void extend(Exposure& exposure, const SceneView& scene, unsigned threads, std::uint64_t seed);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/exposure.cpp>
#endif
