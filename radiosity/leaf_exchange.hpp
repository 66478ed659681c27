// SPDX-License-Identifier: MIT
#pragma once

// The exchange between any two leaves, made when it is asked for and not kept: what methods without links work with. Form factors,
// occluder lists and visibility are those of the links (evaluate.hpp); what can stand between two input faces is looked up once
// for all their leaves.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/evaluate.hpp>
#include <radiosity/material.hpp>
#include <radiosity/occlusion.hpp>
#include <radiosity/oracle.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

[[nodiscard]] inline std::size_t exposed_leaves(const Hierarchy& hierarchy, const Exposure& exposure) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { count += hierarchy[i].leaf() && exposure.area[i] > 0.0 ? 1 : 0; }
  return count;
}

// The exchange between the leaves of which something is exposed.
class LeafExchange {
 public:
  // The references must outlive this; the hierarchy stays as it is.
  LeafExchange(const raycast::Scene& objects, const Plan& plan, const std::vector<Surface>& surfaces, const Hierarchy& hierarchy,
               const Patches& patches, const Exposure& exposure, const LinkEvaluator& evaluator)
      : objects_{&objects}, plan_{&plan}, hierarchy_{&hierarchy}, patches_{&patches}, evaluator_{&evaluator} {
    std::vector<std::uint32_t> root_of(hierarchy.size());  // as an index of roots
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
      if (!node.leaf() || !(exposure.area[i] > 0.0)) { continue; }
      leaves_.push_back(i);
      area_.push_back(exposure.area[i]);
      roots_.push_back(root_of[i]);
    }
    // What can stand between two input faces is looked up once for all their leaves.
    count_ = roots.size();
    lists_.assign(count_ * count_, nothing);
    for (std::size_t p = 0; p < count_; ++p) {
      for (std::size_t q = p; q < count_; ++q) {
        if (!may_exchange(surfaces, roots[p], roots[q], p == q)) { continue; }
        std::uint32_t& index = lists_[p * count_ + q];
        if (p == q) {
          index = OccluderLists::none;
          continue;
        }
        const raycast::OccluderList list = occluders_.of(root_nodes[p], root_nodes[q], OccluderLists::none, objects, plan, patches);
        if (list.blocked() || f_oracle(roots[p], roots[q], 1.0, 0.0) == Decision::drop) { continue; }
        index = lists_[q * count_ + p] = occluders_.keep(list, OccluderLists::none);
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] std::uint32_t node(std::size_t i) const { return leaves_[i]; }
  [[nodiscard]] double area(std::size_t i) const { return area_[i]; }  // exposed

  // A_i F_ij = A_j F_ji with visibility, in the squared unit of the frame. Its doubt has no part by node: leaves express all.
  [[nodiscard]] float operator()(std::size_t i, std::size_t j, RayCount& rays, Doubt* doubt = nullptr) const {
    const std::uint32_t index = lists_[roots_[i] * count_ + roots_[j]];
    if (i == j || index == nothing) { return 0.0f; }
    Link link{leaves_[std::min(i, j)], leaves_[std::max(i, j)]};
    if (f_oracle((*hierarchy_)[link.p], (*hierarchy_)[link.q], 1.0, 0.0) == Decision::drop) { return 0.0f; }
    const raycast::OccluderList list = occluders_.of(link.p, link.q, index, *objects_, *plan_, *patches_);
    if (list.blocked()) { return 0.0f; }
    rays += (*evaluator_)(link, list, nullptr, doubt);
    return link.exchange;
  }

  [[nodiscard]] std::size_t bytes() const { return (lists_.capacity() * sizeof(std::uint32_t)) + occluders_.bytes(); }

 private:
  static constexpr std::uint32_t nothing = 0xfffffffd;  // of two roots: they exchange no light

  // Faces of one flat sheet or of one convex solid do not see each other, and no flat face sees itself.
  [[nodiscard]] static bool may_exchange(const std::vector<Surface>& surfaces, const Node& a, const Node& b, bool same) {
    if (a.object != b.object) { return true; }
    const raycast::PlacedObject& object = *surfaces[a.object].object;
    if (object.convex() && !object.inside()) { return false; }
    return !object.flat() || !(same || a.surface == b.surface);
  }

  const raycast::Scene* objects_;
  const Plan* plan_;
  const Hierarchy* hierarchy_;
  const Patches* patches_;
  const LinkEvaluator* evaluator_;
  std::vector<std::uint32_t> leaves_, roots_;
  std::vector<double> area_;
  std::size_t count_ = 0;             // of roots
  std::vector<std::uint32_t> lists_;  // of each pair of roots
  OccluderLists occluders_;
};

// What the leaves do with light, in the order of LeafExchange.
struct LeafMaterials {
  std::vector<Color> reflectance, emission;
};

// `reflectance` and `emission`: one for each input surface.
[[nodiscard]] inline LeafMaterials leaf_materials(const LeafExchange& exchange, const Hierarchy& hierarchy,
                                                  const std::vector<Color>& reflectance, const std::vector<Color>& emission) {
  LeafMaterials result;
  for (std::size_t i = 0; i < exchange.size(); ++i) {
    result.reflectance.push_back(reflectance[hierarchy[exchange.node(i)].surface]);
    result.emission.push_back(emission[hierarchy[exchange.node(i)].surface]);
  }
  return result;
}

}  // namespace radiosity
