// SPDX-License-Identifier: MIT
#include <radiosity/visibility/exposure.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <brep/geometry.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/inline.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/curved_area.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// The bounds of all objects, to find those near a patch.
class Neighbourhood {
 public:
  Neighbourhood() = default;
  explicit Neighbourhood(const raycast::Scene& scene) {
    for (std::uint32_t i = 0; i < scene.size(); ++i) {
      boxes_.push_back(scene.object(i).bounds());
      if (scene.object(i).inside()) { rooms_.push_back(i); }
    }
    tree_ = raycast::Bvh{boxes_};
    margin_ = 1e-6 * scene.diameter();  // far beyond any skin of raycast/scene.hpp
  }

  // Can anything lie on or over this patch of the object? Not when the bounds of all other objects stay clear of it.
  [[nodiscard]] bool may_be_buried(std::uint32_t object, const Patch& patch) const {
    if (rooms_.size() > 1 || (rooms_.size() == 1 && rooms_.front() != object)) { return true; }
    raycast::Box box;
    for (const glm::dvec3& p : patch.contour) { box.extend(p); }
    box = box.grown(margin_);
    const auto meets = [&](const raycast::Box& other) {
      return glm::all(glm::lessThanEqual(box.lo, other.hi)) && glm::all(glm::lessThanEqual(other.lo, box.hi));
    };
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
      const raycast::Bvh::Node& node = tree_.nodes()[stack.back()];
      stack.pop_back();
      if (!meets(node.box)) { continue; }
      if (node.count == 0) {
        stack.insert(stack.end(), {node.first, node.first + 1});
        continue;
      }
      for (const std::uint32_t item : tree_.items(node)) {
        if (item != object && meets(boxes_[item])) { return true; }
      }
    }
    return false;
  }

 private:
  std::vector<raycast::Box> boxes_;  // one an object
  std::vector<std::uint32_t> rooms_;
  raycast::Bvh tree_;
  double margin_ = 0.0;
};

HALFLIGHT_INLINE void extend(Exposure& exposure, const raycast::Scene& scene, const std::vector<Surface>& surfaces,
                             const Hierarchy& hierarchy, const Patches& patches, unsigned threads, std::uint64_t seed) {
  const std::size_t first_new = exposure.area.size();
  const std::size_t new_nodes = hierarchy.size() - first_new;
  const Neighbourhood neighbourhood{scene};
  std::vector<double>& area = exposure.whole;
  std::vector<double>& exposed = exposure.area;
  std::vector<glm::dvec3>& centroid = exposure.centroid;
  area.resize(hierarchy.size(), 0.0);
  exposed.resize(hierarchy.size(), 0.0);
  centroid.resize(hierarchy.size(), glm::dvec3{0.0});
  exposure.drawn_of.resize(hierarchy.size(), no_node);
  const auto sheet = [&](std::size_t i) { return hierarchy[i].surface - surfaces[hierarchy[i].object].first_surface; };
  const auto key = [&](std::size_t i) { return Random{seed, i, 0x6578706f73656421ull}.bits(); };
  std::vector<char> mixed(new_nodes, 0);  // some of the 16 points are buried, some are not
  parallel_for(new_nodes, threads, [&](std::size_t k) {
    const std::size_t i = first_new + k;
    const Node& node = hierarchy[i];
    if (!node.leaf()) { return; }
    const SurfaceBRep& brep = surfaces[node.object].brep;
    // A separate polygon is all that its quad-tree knows of the surface.
    const bool curved = node.deviation > 0.0 && surfaces[node.object].topology == Topology::shared;
    area[i] =
        curved ? curved_area(scene.object(node.object), sheet(i), patches[i].contour) : glm::length(brep::vector_area(brep, node.face));
    const Patch& patch = patches[i];
    centroid[i] = patch.centroid;
    exposed[i] = area[i];
    if (!neighbourhood.may_be_buried(node.object, patch)) { return; }
    Random random{key(i), 16};
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < 16; ++c) {
      const double u = (c % 4 + random.uniform()) / 4.0;
      count += buried(scene, node.object, sheet(i), sample(patch, u, (c / 4 + random.uniform()) / 4.0)) ? 0u : 1u;
    }
    if (count == 0) { exposed[i] = 0.0; }
    mixed[k] = count > 0 && count < 16 ? 1 : 0;
  });
  // The points of nodes that have none yet.
  const auto draw = [&](const std::vector<std::uint32_t>& nodes) {
    const std::size_t first = exposure.drawn.size();
    exposure.drawn.resize(first + nodes.size());
    parallel_for(nodes.size(), threads, [&](std::size_t k) {
      const std::uint32_t i = nodes[k];
      exposure.drawn_of[i] = static_cast<std::uint32_t>(first + k);
      exposure.drawn[first + k] = ExposedPoints{scene, hierarchy[i].object, sheet(i), patches[i], key(i)};
    });
  };
  std::vector<std::uint32_t> nodes;
  for (std::size_t k = 0; k < new_nodes; ++k) {
    if (mixed[k] != 0) { nodes.push_back(static_cast<std::uint32_t>(first_new + k)); }
  }
  draw(nodes);
  for (const std::uint32_t i : nodes) { exposed[i] = area[i] * (exposure.drawn[exposure.drawn_of[i]].count() / 256.0); }

  exposure.buried_leaves = 0;
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (node.leaf()) {
      exposure.buried_leaves += exposed[i] == 0.0 ? 1 : 0;
      continue;
    }
    area[i] = exposed[i] = 0.0;
    centroid[i] = glm::dvec3{0.0};
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      area[i] += area[c];
      exposed[i] += exposed[c];
      centroid[i] += exposed[c] * centroid[c];
    }
    centroid[i] = exposed[i] > 0.0 ? centroid[i] / exposed[i] : node.centre;
  }
  exposure.partly_buried.resize(hierarchy.size());
  nodes.clear();
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    exposure.partly_buried[i] = exposed[i] > 0.0 && exposed[i] < area[i];
    if (exposure.partly_buried[i] && exposure.drawn_of[i] == no_node && !hierarchy[i].is_cluster()) {
      nodes.push_back(static_cast<std::uint32_t>(i));
    }
  }
  draw(nodes);
  exposure.all_buried = std::none_of(exposed.begin(), exposed.end(), [](double a) { return a > 0.0; });
}

}  // namespace radiosity
