// SPDX-License-Identifier: MIT
#pragma once

// What the mesh of a solution is too coarse for: light on a leaf as it is seen from nearer than the leaf is wide. At the foot of a box the
// light falls off within a leaf; seen from afar the mean over the leaf is right, but in the corner between the two this is most of what a
// point sees, and the corner came out bright. There the light of some of the places that a point sees is followed by paths, to the lamps
// and to places that are no longer near (a second gathering near by; Christensen 1999 for photon maps), and stands for the light of all.
//
// A path that ends by chance on a small bright spot is noise: a row of bright and dark crumbs along a corner. Where spots are that bright,
// each end of a path sends a ray to one of them, too (bright_spots.hpp), by the balance heuristic.
//
// Lamps are chosen by the light that arrives from them around the place (photon_grid.hpp): of a house most are in other rooms.
//
// A path that ends on a lamp by chance counts beside a point of the lamp that was chosen, by the same heuristic: a large lamp near by, such
// as a sky outside a window, is seen where chosen points are few.
//
// Half of the places are chosen by the light that the mesh says they have, half anyhow; what the paths say is unbiased.

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/met.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

class NearLight {
 public:
  // All must outlive this; `materials`: of the input surfaces; `lamp_photons`: their sources are lamps of the direct light.
  NearLight(const Lookup& lookup, const DirectLight& direct, const std::vector<Material>& materials, const PhotonGrid& lamp_photons)
      : lookup_{&lookup}, direct_{&direct}, materials_{&materials}, lamp_photons_{&lamp_photons} {}

  // A place that is seen from so near that the mesh is too coarse for its light, and this light, without that of lamps.
  struct Seen {
    Met at;
    Color light{0.0};
  };
  struct Sum {
    Color light{0.0};
    double variance = 0.0;  // of the sum of its channels
  };
  // The light of all these places, by some paths: a multiple of paths_at_once. How many must not depend on what they find: to stop once
  // they agree would favour those that miss what is bright and rare. `key` fixes the paths; `spots`: what rays are aimed at, or none.
  static constexpr unsigned paths_at_once = 8;
  [[nodiscard]] Sum light(std::span<const Seen> seen, std::uint32_t paths, std::uint64_t key, const BrightSpots::From* spots) const;

 private:
  // Paths from places that are seen, to find how much light these send out, but for that of lamps.
  struct Paths;
  // Adds what chosen points of lamps send to the ends of the paths; what rays meet of them is the rest.
  void light_by_lamps(Paths& paths, std::span<PathNumbers> numbers) const;
  // Casts a ray from the end of each: it ends with the light of what is met, or goes on from there when that is near.
  void go_on(Paths& paths, std::span<PathNumbers> numbers, const BrightSpots::From* spots, bool last) const;
  // Adds what spots send to the ends, from where a ray would end.
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
