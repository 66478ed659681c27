// SPDX-License-Identifier: MIT
#pragma once

// Which sources light a place: photons that landed around it, counted in the cells of grids, the finer ones where photons are many
// ("Importance driven path tracing using the photon map", Jensen 1995). In a house of ten rooms a point is lit by the lamps of its own
// room; the others, which may be brighter and nearer, are behind walls. A source that has no photon here may light a place all the same:
// what is chosen by these shares must be chosen in other ways, too.

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
  // Of the photons on what faces about this way around a place, by ascending source; they sum to 1. Empty where photons are too few to
  // tell.
  [[nodiscard]] std::span<const Share> around(const glm::dvec3& position, const glm::dvec3& normal) const;
  // That of one source; 0 when it has none.
  [[nodiscard]] static double share_of(std::span<const Share> shares, std::uint32_t source);

 private:
  struct Cell {
    std::size_t first = 0, last = 0;
  };

  std::unordered_map<std::uint64_t, Cell> cells_;  // by the hash of grid, cell, and axis of the normal
  std::vector<Share> shares_;
  double width_ = 0.0;  // of the finest cells
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/photon_grid.cpp>
#endif
