// SPDX-License-Identifier: MIT
#pragma once

// Tells which sources light a place: photons that landed around it are counted in the cells of nested grids, of which the finest with
// enough photons is used ("Importance driven path tracing using the photon map", Jensen 1995). In a house of ten rooms a point is lit by
// the lamps of its own room; the others, though perhaps brighter or nearer, are behind walls. A source without photons here may still
// light the place, so sources must also be sampled in another way than by these shares. A source is any number that the user of the grid
// assigns: a lamp, or an emitting surface.

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity {

class PhotonGrid {
 public:
  struct Photon {
    glm::dvec3 position{0.0}, normal{0.0};  // of the point where it landed
    std::uint32_t source = 0;
  };

  PhotonGrid() = default;
  // `diameter`: of the scene.
  PhotonGrid(std::span<const Photon> photons, double diameter);

  [[nodiscard]] bool empty() const { return cells_.empty(); }

  struct Share {
    std::uint32_t source = 0;
    double share = 0.0;
  };
  // The sources of the photons that landed around a place.
  struct Around {
    std::span<const Share> shares;  // shares of the photons, by ascending source; they sum to 1
    // Probability with which a source should be chosen by these shares: smaller where there are too few photons for many sources.
    double trust = 0.0;

    [[nodiscard]] double share_of(std::uint32_t source) const;
    // Chooses a source with the probability of its share, by a number in [0, 1); rescales the number to its position within that share.
    [[nodiscard]] std::uint32_t choose(double& number) const;
  };
  // Of the photons that landed nearby on surfaces of about this orientation. Shares and trust are empty where there are too few photons.
  [[nodiscard]] Around around(const glm::dvec3& position, const glm::dvec3& normal) const;

 private:
  struct Cell {
    std::size_t first = 0, last = 0;  // range of its shares
    double trust = 0.0;
  };

  std::unordered_map<std::uint64_t, Cell> cells_;  // by the hash of grid, cell, and axis of the normal
  std::vector<Share> shares_;
  double width_ = 0.0;  // width of the finest cells
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/photon_grid.cpp>
#endif
