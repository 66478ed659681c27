// SPDX-License-Identifier: MIT
#pragma once

// Rays that leave nodes of the hierarchy, kept with the leaf that each of them meets.
//
// They start at points even over a node, in directions of density cos / pi, so the share of them that meets a leaf estimates the form
// factor to it, with all that stands between (Malley 1988). Start and end lie on the true surfaces, not on the patches.

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
  std::uint32_t to = no_node;        // a leaf; no_node: the ray met nothing, a back, or something without a leaf
  float length = 0.0f;               // to what it met; 0: nothing; below 0: it was not cast, for its start is buried
  glm::vec3 start{0.0f}, end{0.0f};  // from the centres of the nodes on which they lie: a leaf may be too small for floats of the frame
};

// In the order of the nodes, so many of each.
class StoredRays {
 public:
  StoredRays() = default;
  explicit StoredRays(const std::vector<std::uint32_t>& counts, std::pmr::memory_resource* arrays = nullptr);

  [[nodiscard]] std::span<const StoredRay> of(std::size_t node) const { return std::span(rays_).subspan(first_[node], count(node)); }
  [[nodiscard]] std::span<StoredRay> of(std::size_t node) { return std::span(rays_).subspan(first_[node], count(node)); }
  [[nodiscard]] std::size_t count(std::size_t node) const { return first_[node + 1] - first_[node]; }
  [[nodiscard]] std::size_t size() const { return rays_.size(); }

  // 1 / the harmonic mean of the lengths of a node's rays; those that met nothing count as infinitely long, and none as shorter than
  // `shortest`, or a start beside an edge would decide alone. 0 without rays.
  [[nodiscard]] double nearness(std::size_t node, double shortest) const;

 private:
  std::vector<std::size_t> first_{0};
  BigArray<StoredRay> rays_;
};

// 400 million rays are 60 GB when links are made of them; a run that asks for more is refused rather than left to exhaust the memory.
inline constexpr std::uint64_t ray_limit = 400'000'000;

// Casts counts[i] rays from node i, from what is exposed of its leaves: where that is not known yet, rays whose start is buried are left
// out, and only leaves may cast. Ends early, with rays missing, when the scene's control says so.
[[nodiscard]] StoredRays cast_rays(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<std::uint32_t>& counts);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/stored_rays.cpp>
#endif
