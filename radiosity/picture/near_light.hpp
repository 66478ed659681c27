// SPDX-License-Identifier: MIT
#pragma once

// Corrects light for which the solution's mesh is too coarse: that of a leaf seen from a distance smaller than its width. At the foot of
// a box the light falls off within a leaf. Seen from far away the mean over the leaf suffices, but from the corner itself this leaf is
// most of what a point sees, and the corner would come out too bright. So some of the nearby places that a point sees are followed by
// paths, to the lamps and to places that are no longer near (a second gathering; Christensen 1999 for photon maps); the result replaces
// the light of all of them.
//
// A path that ends on a small bright spot by chance causes noise: bright and dark dots along a corner. If there are such spots, the end
// of each path also sends a ray to one of them (bright_spots.hpp), weighted by the balance heuristic.
//
// Lamps are chosen by the light that arrives from them near the place (photon_grid.hpp), because in a house most lamps are in other rooms.
//
// A path that hits a lamp by chance is combined with the chosen points of lamps by the same heuristic: few chosen points reach the
// visible part of a large lamp near by, such as a sky outside a window.
//
// Half of the places are chosen by the light that the mesh shows, half uniformly; so the result is unbiased even if the mesh is wrong.

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

class NearLight {
 public:
  // All arguments must outlive this. `materials`: of the input surfaces; `lamp_photons`: their sources are indices of the
  // direct light's lamps.
  NearLight(const Lookup& lookup, const DirectLight& direct, const std::vector<Material>& materials, const PhotonGrid& lamp_photons)
      : lookup_{&lookup}, direct_{&direct}, materials_{&materials}, lamp_photons_{&lamp_photons} {}

  // A place seen from so near that the mesh is too coarse for its light, and this light without that of lamps.
  struct Seen {
    raycast::ScenePoint at;
    Color light{0.0};
  };
  struct Sum {
    Color light{0.0};
    double variance = 0.0;  // of the sum of the channels
  };
  // Estimates the light of all these places with `paths` paths, a multiple of paths_at_once. The number must not depend on results:
  // stopping once paths agree would favour those that miss rare bright light. `key` determines the paths; `spots`: targets of further
  // rays, or null.
  static constexpr unsigned paths_at_once = 8;
  [[nodiscard]] Sum light(std::span<const Seen> seen, std::uint32_t paths, std::uint64_t key, const BrightSpots::From* spots) const;

 private:
  // Paths from the places that are seen, which estimate the light that these reflect or emit, except for emission of lamps.
  struct Paths;
  // Adds the light of chosen points of lamps at the ends of the paths; rays that hit lamps add the rest.
  void light_by_lamps(Paths& paths, std::span<PathNumbers> numbers) const;
  // Casts a ray from the end of each path. The path ends with the light of the hit, or continues from there if the hit is near.
  void go_on(Paths& paths, std::span<PathNumbers> numbers, const BrightSpots::From* spots, bool last) const;
  // Adds the light of spots at the ends of the paths, for directions in which a ray would end the path.
  void light_by_spots(Paths& paths, std::span<PathNumbers> numbers, const BrightSpots::From& spots, bool last) const;

  const Lookup* lookup_;
  const DirectLight* direct_;
  const std::vector<Material>* materials_;
  const PhotonGrid* lamp_photons_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/near_light.cpp>
#endif
