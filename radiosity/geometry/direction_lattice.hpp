// SPDX-License-Identifier: MIT
#pragma once

// The directions in which clusters send and receive light: 98 points of a lattice on a cube, four steps an edge.
//
// A surface with normal n shows the projected area max(0, n . d) in direction d. A cluster cannot store this for every d. It stores it at
// the lattice points d_k, and in between uses that every vector is a non-negative combination d = sum_k w_k d_k of three neighbouring
// lattice points (aim() below):
//
//     max(0, n . d)  ~  sum_k w_k max(0, n . d_k)
//
// This is linear in what a cluster sends and receives, so the operator stays linear; both ends use the same weights, so it stays
// symmetric. The approximation is never negative and never too small, and it is exact where n faces all three d_k or none. So a face that
// is turned away from d by more than the spacing of the lattice, 35.3 degrees, gets exactly nothing; one that is turned away by less gets
// a little from those d_k that it faces: 1.2 % of all light, averaged over normals and directions.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace radiosity {

inline constexpr std::size_t direction_count = 98;

namespace detail {

struct DirectionLattice {
  std::array<std::uint8_t, 125> index{};              // number of the lattice point (i, j, k), each from 0 to 4
  std::array<double, direction_count> x{}, y{}, z{};  // the points, from -2 to 2
};

constexpr DirectionLattice make_direction_lattice() {
  DirectionLattice lattice;
  std::size_t count = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 5; ++k) {
        const bool inner = i % 4 != 0 && j % 4 != 0 && k % 4 != 0;
        if (inner) { continue; }
        lattice.index[static_cast<std::size_t>(25 * i + 5 * j + k)] = static_cast<std::uint8_t>(count);
        lattice.x[count] = i - 2;
        lattice.y[count] = j - 2;
        lattice.z[count] = k - 2;
        ++count;
      }
    }
  }
  return lattice;
}
inline constexpr DirectionLattice direction_lattice = make_direction_lattice();

}  // namespace detail

// Three directions of the lattice with non-negative weights: v = sum of weight * direction.
struct Aim {
  std::array<std::uint32_t, 3> direction{};
  std::array<double, 3> weight{};
};

[[nodiscard]] Aim aim(const glm::dvec3& v);

// The projected area of a unit area with this normal in direction k of the lattice.
[[nodiscard]] inline double shown(const glm::dvec3& normal, std::size_t k) {
  const detail::DirectionLattice& d = detail::direction_lattice;
  return std::max(0.0, normal.x * d.x[k] + normal.y * d.y[k] + normal.z * d.z[k]);
}
[[nodiscard]] double shown(const glm::dvec3& normal, const Aim& towards);

// Adds `amount` times the projected area of this normal to the bin of every direction. `bins` has direction_count entries.
inline void add_shown(const glm::dvec3& normal, double amount, double* bins) {
  for (std::size_t k = 0; k < direction_count; ++k) { bins[k] += amount * shown(normal, k); }
}
// The sum over all directions of bins[k] * shown(normal, k), as two partial sums in a fixed order.
[[nodiscard]] double dot_shown(const glm::dvec3& normal, const double* bins);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/direction_lattice.cpp>
#endif
