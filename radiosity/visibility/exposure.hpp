// SPDX-License-Identifier: MIT
#pragma once

// The exposed area of every node: the part of a patch that is not buried under another object. A floor under a box or
// a ceiling behind a lamp neither receives nor gives light; without this the cells at the feet of a box come out dark,
// because they would average the light over ground that nobody sees.
//
// Invariant: the area of an inner node is the sum of the areas of its children, bit by bit.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

struct Exposure {
  std::vector<double> area;             // exposed area of each node, in the frame
  std::vector<double> whole;            // the same with what is buried
  std::vector<glm::dvec3> centroid;     // of the exposed area of each node: area-weighted mean over its leaves
  std::vector<bool> partly_buried;      // some of the node is hidden, but not all
  std::vector<ExposedPoints> drawn;     // of nodes that are, or were, partly buried
  std::vector<std::uint32_t> drawn_of;  // of each node: index of its points, or no_node
  bool all_buried = false;
  std::uint32_t buried_leaves = 0;  // leaves of which nothing is exposed

  // Exposed points of a node of which a part is buried, else null; null as well where so little shows that no point was found.
  [[nodiscard]] const ExposedPoints* points(std::size_t i) const {
    return partly_buried[i] && drawn_of[i] != no_node && drawn[drawn_of[i]].count() > 0 ? &drawn[drawn_of[i]] : nullptr;
  }
};

// Measures the leaves among the nodes that are new since the last call and sums all up. Leaves near other objects are measured by 16
// stratified points, 256 where these disagree: the standard error of the area is at most 1/32 of a leaf at the border of what is hidden.
// Needs the patches of all nodes.
void extend(Exposure& exposure, const SceneView& scene, unsigned threads, std::uint64_t seed);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/exposure.cpp>
#endif
