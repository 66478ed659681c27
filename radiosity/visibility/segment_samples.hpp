// SPDX-License-Identifier: MIT
#pragma once

// Draws the sixteen segments of one round of visibility() between two whole patches of three or four corners, eight at a time
// (instruction_sets.hpp); with the same numbers as one by one.

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/isa.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity::detail {

// The triangles around corner 0 of a patch, computed once for many samples.
struct SamplePieces {
  // Requires fits(patch).
  explicit SamplePieces(const Patch& patch);
  [[nodiscard]] static bool fits(const Patch& patch) {
    return patch.parts.empty() && (patch.contour.size() == 3 || patch.contour.size() == 4);
  }

  glm::dvec3 origin{0.0}, normal{0.0};
  std::array<glm::dvec3, 3> edges{};  // from the origin to the other corners
  double whole = 0.0;                 // area of the patch
  double split = 0.0;                 // area at which the second triangle begins; infinite if there is none
  std::array<double, 2> area{};
};

// Both ends of the segments. `softening` limits the weight of points that nearly touch.
struct SampledPair {
  SamplePieces p, q;
  double softening = 0.0;
};

struct SampledSegments {
  raycast::Segments16 segments;     // only origins and directions are set
  std::array<double, 16> weight{};  // cos cos / r^2, softened; 0 below a horizon
};

// Uses the numbers of a Random with this `state`, which must be advanced by 64 afterwards. Segment i runs from cell i of p to cell
// opposite_cell(i, shift) of q.
inline constexpr std::uint64_t numbers_per_round = 64;
void draw_segments(const SampledPair& between, std::uint64_t state, std::uint32_t shift, SampledSegments& to, raycast::Isa set);

[[nodiscard]] constexpr std::uint32_t opposite_cell(std::uint32_t cell, std::uint32_t shift) { return (cell * 5u ^ shift) & 15u; }

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/segment_samples.cpp>
#endif
