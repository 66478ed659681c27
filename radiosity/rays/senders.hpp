// SPDX-License-Identifier: MIT
#pragma once

// How large a node that casts rays may be for those that see it. Its rays, and rays that meet it, carry the mean of its light even where
// the light of lamps has split it further. Patches near by see whether the part before them is lit or in shadow, so there it must be small.

#include <array>
#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// The largest radius of a node, relative to the length of a ray that is counted for it and to the distance of what is seen from it.
inline constexpr double most_pooled = 0.4;

// A node from which rays are cast. No other lies above or below it.
struct Caster {
  std::uint32_t node = 0;
  // How much the light of its rays scatters, reflected, relative to the RMS of what reflects the light of lamps; rough.
  double weight = 0.0;
};

// What a caster sees, by a few rays.
struct CasterView {
  struct Seen {
    std::uint32_t leaf = no_node;
    float distance = 0.0f;
  };
  std::uint32_t node = no_node;  // the caster
  double area = 0.0;             // of it, as a share of all, times its weight in the picture (view_importance.hpp)
  double reflectance = 0.0;
  std::array<Seen, 16> rays{};
};

// Puts children in the place of casters until the RMS error that what each sends has where it is seen, by the `views` of all, is at most
// `tolerance`. `brightness`: of each node, in the unit of the tolerance.
[[nodiscard]] std::vector<Caster> split_senders(const DiscreteScene& scene, std::vector<Caster> casters,
                                                const std::vector<CasterView>& views, const std::vector<double>& brightness,
                                                double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/senders.cpp>
#endif
