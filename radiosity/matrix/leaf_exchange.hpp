// SPDX-License-Identifier: MIT
#pragma once

// The exchange between any two leaves, computed on request and not stored; used by the methods without links. Form factors, occluder
// lists and visibility are those of the links (evaluate.hpp). The possible blockers of two input faces are found once for all their leaves.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

[[nodiscard]] std::size_t exposed_leaves(const Hierarchy& hierarchy, const Exposure& exposure);

// The exchange between leaves with exposed area.
class LeafExchange {
 public:
  // `scene` must outlive this, and its hierarchy must not change.
  explicit LeafExchange(const DiscreteScene& scene);

  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] std::uint32_t node(std::size_t i) const { return leaves_[i]; }
  [[nodiscard]] double area(std::size_t i) const { return area_[i]; }  // exposed area

  // A_i F_ij = A_j F_ji with visibility, in squared units of the frame. Doubt::p and q are 0, because leaves have no children.
  [[nodiscard]] float operator()(std::size_t i, std::size_t j, RayCount& rays, Doubt* doubt = nullptr) const;

  [[nodiscard]] std::size_t bytes() const { return (lists_.capacity() * sizeof(std::uint32_t)) + occluders_.bytes(); }

 private:
  static constexpr std::uint32_t nothing = 0xfffffffd;  // marks two roots that exchange no light

  // False for faces of one flat sheet or of one convex solid, which do not see each other, and for a flat face and itself.
  [[nodiscard]] static bool may_exchange(const std::vector<Surface>& surfaces, const Node& a, const Node& b, bool same);

  const DiscreteScene* scene_;
  std::vector<std::uint32_t> leaves_, roots_;
  std::vector<double> area_;
  std::size_t count_ = 0;             // number of roots
  std::vector<std::uint32_t> lists_;  // by pair of roots
  OccluderLists occluders_;
};

// Materials of the leaves, in the order of LeafExchange.
struct LeafMaterials {
  std::vector<Color> reflectance, emission;
};

[[nodiscard]] LeafMaterials leaf_materials(const LeafExchange& exchange, const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/matrix/leaf_exchange.cpp>
#endif
