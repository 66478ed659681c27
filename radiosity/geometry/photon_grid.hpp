// SPDX-License-Identifier: MIT
#pragma once

// Which sources light a place: photons that landed around it, counted in the cells of grids, the finer ones where photons are many
// ("Importance driven path tracing using the photon map", Jensen 1995). In a house of ten rooms a point is lit by the lamps of its own
// room; the others, which may be brighter and nearer, are behind walls. A source that has no photon here may light a place all the same:
// what is chosen by these shares must be chosen in other ways, too. A source is what the user of the grid numbers so: lamps, or emitting
// surfaces.

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
    glm::dvec3 position{0.0}, normal{0.0};  // of the place where it landed
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
    std::span<const Share> shares;  // of the photons, by ascending source; they sum to 1
    // How often a source should be chosen by these shares: less where photons are too few to tell many sources apart.
    double trust = 0.0;

    [[nodiscard]] double share_of(std::uint32_t source) const;
    // A source by a number in [0, 1), with the probability of its share; the number becomes its place within that share.
    [[nodiscard]] std::uint32_t choose(double& number) const;
  };
  // Of the photons on what faces about this way. Without shares and trust where they are too few.
  [[nodiscard]] Around around(const glm::dvec3& position, const glm::dvec3& normal) const;

 private:
  struct Cell {
    std::size_t first = 0, last = 0;  // shares
    double trust = 0.0;
  };

  std::unordered_map<std::uint64_t, Cell> cells_;  // by the hash of grid, cell, and axis of the normal
  std::vector<Share> shares_;
  double width_ = 0.0;  // of the finest cells
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/photon_grid.cpp>
#endif
