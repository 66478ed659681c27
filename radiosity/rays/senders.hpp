// SPDX-License-Identifier: MIT
#pragma once

// Limits the size of casting nodes by the error of what they send. Rays to and from a caster use the mean of its light, even if the light
// of lamps has split it further. Patches near by see whether the part in front of them is lit or in shadow, so there a caster must be
// small.

#include <array>
#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// Largest radius of a node, relative to the length of a ray counted for it and to the distance of what it sees.
inline constexpr double most_pooled = 0.4;

// A node from which rays are cast. No caster is an ancestor of another one.
struct Caster {
  std::uint32_t node = 0;
  // Rough standard deviation of the reflected light over its rays, relative to the RMS of the light of lamps reflected in the scene.
  double weight = 0.0;
};

// What a caster sees, sampled by a few rays.
struct CasterView {
  struct Seen {
    std::uint32_t leaf = no_node;
    float distance = 0.0f;
  };
  std::uint32_t node = no_node;  // the caster
  double area = 0.0;             // share of the total area, times its weight in the picture (view_importance.hpp)
  double reflectance = 0.0;
  std::array<Seen, 16> rays{};
};

// Replaces casters by their children until the RMS error of the light that each sends, at the places that see it according to `views`, is
// at most `tolerance`. `brightness`: by node, in the unit of the tolerance.
[[nodiscard]] std::vector<Caster> split_senders(const DiscreteScene& scene, std::vector<Caster> casters,
                                                const std::vector<CasterView>& views, const std::vector<double>& brightness,
                                                double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/senders.cpp>
#endif
