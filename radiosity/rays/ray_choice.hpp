// SPDX-License-Identifier: MIT
#pragma once

// Decides which runs carry the light between surfaces that are not lamps by stored rays instead of links.

#include <cstdint>
#include <string>

#include <radiosity/scene/options.hpp>

namespace radiosity {

struct RayChoice {
  bool cast = false;
  std::string reason;  // why not, if `cast` is false
  // Lamps are linked cluster by cluster, and surfaces that emit little more than the mean do not count as lamps; if rays are cast, their
  // light goes by these, too.
  bool many_lamps = false;
  bool few = false;  // is the small number of input faces, or of those that do not shine, the only reason for not casting?
};

// Up to this many emitting faces are linked one by one; with more, clusters of them are faster.
inline constexpr std::uint64_t most_single_lamps = 64;

// From this number of input faces on rays pay; links among fewer are made quickly and have no noise. Measured on rooms of 19 to 10 000
// faces.
inline constexpr std::uint64_t rays_from = 100;

// The same where most of the faces are those of a sky. Measured on houses of 10 to 90 faces below one of 216.
inline constexpr std::uint64_t sky_rays_from = 300;

// Rays also pay among few faces if the RMS of the light reflected once exceeds this multiple of the mean emission. Then the brightest
// surface lies close beside a lamp, which hides it from most of the scene, and the single visible fraction of a link with a whole ceiling
// does not represent that: by links, walls and floors were 8 % too bright with a lamp 5 cm below the ceiling, 15 % with 1 cm, and 20 to
// 30 % with cylinders touching it. By rays they are within some 3 %, in half of the time.
//
// They also pay if the picture is much darker than the scene (run/f_refinement.cpp). Its light then enters through small openings, and
// the single visible fraction of a link says little about these: rooms behind holes of 10 to 30 cm had 16 to 26 % too much or too little
// light (RMS) by links, 8 % by rays (dim_rooms_test).
inline constexpr double least_share_beside_lamps = 4.0;

// Numbers of input faces.
struct FaceCounts {
  std::uint64_t all = 0;
  std::uint64_t shining = 0;        // those that emit
  std::uint64_t lamps = 0;          // those of them that are lamps (lamp_choice.hpp)
  std::uint64_t uncut_shining = 0;  // those that emit before long ones were cut, whose parts are linked one by one while they are few

  [[nodiscard]] bool most_shine() const { return 2 * shining > all; }
  [[nodiscard]] bool of_sky() const { return most_shine() && shining < all; }  // above those that do not
  // Too many pairs of a face that shines and any other for linking them one by one?
  [[nodiscard]] bool many_pairs() const { return shining * all > 4'000'000; }
};

[[nodiscard]] inline RayChoice choose_rays(const FaceCounts& faces, const Options& options) {
  if (options.indirect == Indirect::links) { return {false, "all light was asked to go by links"}; }
  if (options.oracle) { return {false, "an oracle was supplied to choose all links"}; }
  if (options.refinement == Refinement::a_posteriori) { return {false, "BF-refinement splits links by what they carry"}; }
  if (options.solver == Solver::gauss_seidel || options.solver == Solver::southwell) {
    return {false, "Gauss-Seidel and Southwell go through the links of one patch at a time"};
  }
  const std::uint64_t others = faces.all - faces.shining;
  if (options.indirect == Indirect::automatic) {
    // Lamps of many faces have clusters whether rays are cast or not. Without, a bulb of 1152 faces in its shade took 56 s, and the shade
    // was 14 % too dark; with these, and rays because it is lit beside the lamp, 5 s and 4 %.
    const bool many_lamps = faces.lamps > most_single_lamps;
    if (faces.all < rays_from) {
      return {false, "they pay from some " + std::to_string(rays_from) + " input faces on, there are " + std::to_string(faces.all),
              many_lamps, true};
    }
    // Most of the interreflected light is that between the other faces. Under a sky of many faces, which is no lamp, rays take a tenth of
    // the time of links for pictures as good.
    if (faces.most_shine() && others < rays_from && !faces.many_pairs() && (many_lamps || faces.all < sky_rays_from)) {
      return {false, "most input faces shine, and are few enough to be linked", many_lamps, true};
    }
  }
  return {true, {}, faces.uncut_shining > most_single_lamps || faces.many_pairs() || faces.most_shine()};
}

}  // namespace radiosity
