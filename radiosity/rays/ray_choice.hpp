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
  // Lamps are linked cluster by cluster, and what shines over much of the scene is no lamp: its light goes by rays, too.
  bool many_lamps = false;
  bool few = false;  // none are cast because input faces are few, and for no other reason
};

// So many faces that shine are linked one by one. More of them take longer than clusters of them.
inline constexpr std::uint64_t most_single_lamps = 64;

// Rays pay from so many input faces on: the links among fewer are soon made, and have no noise. Measured on rooms of 19 to 10 000 faces.
inline constexpr std::uint64_t rays_from = 100;

// Among few faces, too, rays pay where the RMS of what lamps light directly is more than this times the mean emission: then what shines
// brightest lies close beside a lamp, which hides it from most of the scene. One visible fraction for a whole ceiling does not tell that:
// walls and floors were 8 % too bright by links where a lamp hung 5 cm below it, 15 % at 1 cm, 20 to 30 % where cylinders touched it. By
// rays they are within some 3 %, in half of the time.
//
// And so they do where a picture is as dark beside the scene as importance tells (run/f_refinement.cpp): its light comes in through small
// openings, of which the visible fraction of a link tells little. Rooms behind holes of 10 to 30 cm had 16 to 26 % too much or too little
// light by links (RMS), 8 % by rays (dim_rooms_test).
inline constexpr double least_share_beside_lamps = 4.0;

// `faces`: input faces, `lamps` among them; `uncut`: these before long ones were cut, whose parts are linked one by one while they are few.
[[nodiscard]] inline RayChoice choose_rays(std::uint64_t faces, std::uint64_t lamps, std::uint64_t uncut, const Options& options) {
  if (options.indirect == Indirect::links) { return {false, "all light was asked to go by links"}; }
  if (options.oracle) { return {false, "an oracle was supplied to choose all links"}; }
  if (options.refinement == Refinement::a_posteriori) { return {false, "BF-refinement splits links by what they carry"}; }
  if (options.solver == Solver::gauss_seidel || options.solver == Solver::southwell) {
    return {false, "Gauss-Seidel and Southwell go through the links of one patch at a time"};
  }
  if (options.indirect == Indirect::automatic && faces < rays_from) {
    return {false, "they pay from some " + std::to_string(rays_from) + " input faces on, there are " + std::to_string(faces), false, true};
  }
  constexpr std::uint64_t most_pairs = 4'000'000;
  // The light that goes to and fro is that between the others. Under a sky of many faces links told a street 30 % too much, a church 60 %.
  if (options.indirect == Indirect::automatic && 2 * lamps > faces && faces - lamps < rays_from && lamps * faces <= most_pairs) {
    return {false, "most input faces shine, and are few enough to be linked"};
  }
  return {true, {}, uncut > most_single_lamps || lamps * faces > most_pairs || 2 * lamps > faces};
}

}  // namespace radiosity
