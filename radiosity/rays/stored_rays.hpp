// SPDX-License-Identifier: MIT
#pragma once

// Rays that start on nodes of the hierarchy, stored with the leaf that each of them hits.
//
// They start at points uniform over a node, in cosine-distributed directions, so the fraction of them that hits a leaf estimates the form
// factor to it, occlusion included (Malley 1988). Start and end lie on the true surfaces, not on the patches.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/big_array.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

namespace radiosity {

struct StoredRay {
  std::uint32_t to = no_node;        // the leaf; no_node: nothing was hit, or a back face, or something without a leaf
  float length = 0.0f;               // distance of the hit; 0: nothing was hit; < 0: not cast, because its start is buried
  glm::vec3 start{0.0f}, end{0.0f};  // relative to the centres of their nodes, because a leaf may be too small for floats in the frame
};

// Rays in the order of the nodes, with a given number for each.
class StoredRays {
 public:
  StoredRays() = default;
  explicit StoredRays(const std::vector<std::uint32_t>& counts, std::pmr::memory_resource* arrays = nullptr);

  [[nodiscard]] std::span<const StoredRay> of(std::size_t node) const { return std::span(rays_).subspan(first_[node], count(node)); }
  [[nodiscard]] std::span<StoredRay> of(std::size_t node) { return std::span(rays_).subspan(first_[node], count(node)); }
  [[nodiscard]] std::size_t count(std::size_t node) const { return first_[node + 1] - first_[node]; }
  [[nodiscard]] std::size_t size() const { return rays_.size(); }

  // 1 / harmonic mean length of a node's rays. Rays without a hit count as infinitely long; lengths below `shortest` count as `shortest`,
  // because otherwise a start beside an edge would dominate. 0 without rays.
  [[nodiscard]] double nearness(std::size_t node, double shortest) const;

 private:
  std::vector<std::size_t> first_{0};
  BigArray<StoredRay> rays_;
};

// 400 million rays take 60 GB when links are made of them; a run that asks for more is refused instead of exhausting the memory.
inline constexpr std::uint64_t ray_limit = 400'000'000;

// What rays are cast for. Rays for different uses are independent of each other: if the number of a node's rays depended on what some of
// them meet, their mean would be too low, because nodes that miss a small bright thing by chance would get few more rays, and nodes that
// meet it many.
enum class RayUse : std::uint64_t { links, spacing, shots };

// Casts counts[i] rays from node i, from the exposed part of its leaves. If exposure is not known yet, only leaves may cast, and rays
// whose start is buried are left out. Ends early, with rays missing, when the scene's control is cancelled.
[[nodiscard]] StoredRays cast_rays(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<std::uint32_t>& counts,
                                   RayUse use = RayUse::links);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/stored_rays.cpp>
#endif
