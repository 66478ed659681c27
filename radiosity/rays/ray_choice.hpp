// SPDX-License-Identifier: MIT
#pragma once

// Which runs carry the light between surfaces that do not shine by stored rays.

#include <cstdint>
#include <string>

#include <radiosity/scene/options.hpp>

namespace radiosity {

struct RayChoice {
  bool cast = false;
  std::string reason;  // why not
};

// Rays pay from so many input faces on: the links among fewer are soon made, and have no noise. Measured on rooms of 19 to 10 000 faces.
inline constexpr std::uint64_t rays_from = 100;

// `faces`: input faces, `lamps` among them.
[[nodiscard]] inline RayChoice choose_rays(std::uint64_t faces, std::uint64_t lamps, const Options& options) {
  if (options.indirect == Indirect::links) { return {false, "all light was asked to go by links"}; }
  if (options.oracle) { return {false, "an oracle was supplied to choose all links"}; }
  if (options.refinement == Refinement::a_posteriori) { return {false, "BF-refinement splits links by what they carry"}; }
  if (options.solver == Solver::gauss_seidel || options.solver == Solver::southwell) {
    return {false, "Gauss-Seidel and Southwell go through the links of one patch at a time"};
  }
  if (2 * lamps > faces) { return {false, "most input faces shine"}; }
  constexpr std::uint64_t most_pairs = 4'000'000;
  if (lamps * faces > most_pairs) { return {false, "the lamps have " + std::to_string(lamps) + " faces, too many to link each with all"}; }
  if (options.indirect == Indirect::automatic && faces < rays_from) {
    return {false, "they pay from some " + std::to_string(rays_from) + " input faces on, there are " + std::to_string(faces)};
  }
  return {true, {}};
}

}  // namespace radiosity
