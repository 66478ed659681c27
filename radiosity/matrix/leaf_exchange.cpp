// SPDX-License-Identifier: MIT
#include <radiosity/matrix/leaf_exchange.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::size_t exposed_leaves(const Hierarchy& hierarchy, const Exposure& exposure) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { count += hierarchy[i].leaf() && exposure.area[i] > 0.0 ? 1 : 0; }
  return count;
}

HALFLIGHT_INLINE LeafExchange::LeafExchange(const DiscreteScene& scene) : scene_{&scene} {
  const Hierarchy& hierarchy = scene.hierarchy;
  std::vector<std::uint32_t> root_of(hierarchy.size());  // index into `roots`
  std::vector<std::uint32_t> root_nodes;
  Hierarchy roots;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    const Node& node = hierarchy[i];
    if (node.is_cluster()) { continue; }
    if (is_input_face(hierarchy, i)) {
      root_of[i] = static_cast<std::uint32_t>(roots.size());
      roots.push_back(node);
      root_nodes.push_back(i);
    } else {
      root_of[i] = root_of[node.parent];
    }
    if (!node.leaf() || !(scene.exposure.area[i] > 0.0)) { continue; }
    leaves_.push_back(i);
    area_.push_back(scene.exposure.area[i]);
    roots_.push_back(root_of[i]);
  }
  // The possible blockers of two input faces are found once for all their leaves.
  count_ = roots.size();
  lists_.assign(count_ * count_, nothing);
  for (std::size_t p = 0; p < count_; ++p) {
    for (std::size_t q = p; q < count_; ++q) {
      if (!may_exchange(scene.surfaces, roots[p], roots[q], p == q)) { continue; }
      std::uint32_t& index = lists_[p * count_ + q];
      if (p == q) {
        index = OccluderLists::none;
        continue;
      }
      const raycast::OccluderList list = occluders_.of(root_nodes[p], root_nodes[q], OccluderLists::none, scene.view());
      if (list.blocked() || face_away(roots[p], roots[q])) { continue; }
      index = lists_[q * count_ + p] = occluders_.keep(list, OccluderLists::none);
    }
  }
}

HALFLIGHT_INLINE float LeafExchange::operator()(std::size_t i, std::size_t j, RayCount& rays, Doubt* doubt) const {
  const std::uint32_t index = lists_[roots_[i] * count_ + roots_[j]];
  if (i == j || index == nothing) { return 0.0f; }
  Link link{leaves_[std::min(i, j)], leaves_[std::max(i, j)]};
  if (face_away(scene_->hierarchy[link.p], scene_->hierarchy[link.q])) { return 0.0f; }
  const raycast::OccluderList list = occluders_.of(link.p, link.q, index, scene_->view());
  if (list.blocked()) { return 0.0f; }
  rays += scene_->evaluator(link, list, nullptr, doubt);
  if (doubt != nullptr) { doubt->p = doubt->q = 0.0f; }
  return link.exchange;
}

HALFLIGHT_INLINE bool LeafExchange::may_exchange(const std::vector<Surface>& surfaces, const Node& a, const Node& b, bool same) {
  if (a.object != b.object) { return true; }
  const raycast::PlacedObject& object = *surfaces[a.object].object;
  if (object.convex() && !object.inside()) { return false; }
  return !object.flat() || !(same || a.surface == b.surface);
}

HALFLIGHT_INLINE LeafMaterials leaf_materials(const LeafExchange& exchange, const DiscreteScene& scene) {
  LeafMaterials result;
  for (std::size_t i = 0; i < exchange.size(); ++i) {
    const std::uint32_t surface = scene.hierarchy[exchange.node(i)].surface;
    result.reflectance.push_back(scene.reflectance[surface]);
    result.emission.push_back(scene.emission[surface]);
  }
  return result;
}

}  // namespace radiosity
