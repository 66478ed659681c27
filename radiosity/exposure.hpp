// SPDX-License-Identifier: MIT
#pragma once

// The exposed area of every node: the part of a patch that is not buried under another object. A floor under a box or
// a ceiling behind a lamp neither receives nor gives light; without this the cells at the feet of a box come out dark,
// because they would average the light over ground that nobody sees.
//
// Invariant: the area of an inner node is the sum of the areas of its children, bit by bit.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/hierarchy.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/random.hpp>
#include <radiosity/surface.hpp>
#include <radiosity/visibility.hpp>

namespace radiosity {

struct Exposure {
  std::vector<double> area;          // exposed area of each node, in the frame
  std::vector<glm::dvec3> centroid;  // of the exposed area of each node: area-weighted mean over its leaves
  std::vector<bool> partly_buried;   // some of the node is hidden, but not all
  bool all_buried = false;
  std::uint32_t buried_leaves = 0;  // leaves of which nothing is exposed
};

// Leaves are measured by 16 stratified points, 256 where these disagree: the standard error of the area is at most
// 1/32 of a leaf at the border of what is hidden.
[[nodiscard]] inline Exposure measure_exposure(const raycast::Scene& scene, const std::vector<Surface>& surfaces,
                                               const Hierarchy& hierarchy, unsigned threads, std::uint64_t seed) {
  std::vector<double> area(hierarchy.size(), 0.0);
  std::vector<double> exposed(hierarchy.size(), 0.0);
  std::vector<glm::dvec3> centroid(hierarchy.size(), glm::dvec3{0.0});
  parallel_for(hierarchy.size(), threads, [&](std::size_t i) {
    const Node& node = hierarchy[i];
    if (!node.leaf()) { return; }
    const SurfaceBRep& brep = surfaces[node.object].brep;
    area[i] = glm::length(brep::vector_area(brep, node.face));
    const Patch patch = make_patch(contour(surfaces, hierarchy, static_cast<std::uint32_t>(i)));
    centroid[i] = patch.centroid;
    const std::uint32_t sheet = brep.data(node.face).sheet;
    Random random{seed, i, 0x6578706f73656421ull};
    const auto count_exposed = [&](std::uint32_t side) {
      std::uint32_t count = 0;
      for (std::uint32_t k = 0; k < side * side; ++k) {
        const double u = (k % side + random.uniform()) / side;
        const double v = (k / side + random.uniform()) / side;
        count += buried(scene, node.object, sheet, sample(patch, u, v)) ? 0u : 1u;
      }
      return count;
    };
    const std::uint32_t first = count_exposed(4);
    exposed[i] = area[i] * (first == 16 ? 1.0 : first == 0 ? 0.0 : count_exposed(16) / 256.0);
  });

  Exposure exposure;
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    for (std::uint32_t k = 0; k < node.child_count; ++k) {
      area[i] += area[node.first_child + k];
      exposed[i] += exposed[node.first_child + k];
      centroid[i] += exposed[node.first_child + k] * centroid[node.first_child + k];
    }
    if (!node.leaf()) { centroid[i] = exposed[i] > 0.0 ? centroid[i] / exposed[i] : node.centre; }
    if (node.leaf() && exposed[i] == 0.0) { ++exposure.buried_leaves; }
  }
  exposure.partly_buried.resize(hierarchy.size());
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { exposure.partly_buried[i] = exposed[i] > 0.0 && exposed[i] < area[i]; }
  exposure.all_buried = std::none_of(exposed.begin(), exposed.end(), [](double a) { return a > 0.0; });
  exposure.area = std::move(exposed);
  exposure.centroid = std::move(centroid);
  return exposure;
}

}  // namespace radiosity
