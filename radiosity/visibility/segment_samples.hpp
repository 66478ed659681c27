// SPDX-License-Identifier: MIT
#pragma once

// The sixteen segments of one round of visibility() between two whole patches of three or four corners, drawn eight at once
// (instruction_sets.hpp): the same numbers as segment by segment.

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/isa.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity::detail {

// The triangles around corner 0 of a patch, made once for many samples.
struct SamplePieces {
  // Requires fits(patch).
  explicit SamplePieces(const Patch& patch);
  [[nodiscard]] static bool fits(const Patch& patch) {
    return patch.parts.empty() && (patch.contour.size() == 3 || patch.contour.size() == 4);
  }

  glm::dvec3 origin{0.0}, normal{0.0};
  std::array<glm::dvec3, 3> edges{};  // from the origin to the other corners
  double whole = 0.0;                 // area of the patch
  double split = 0.0;                 // where the second triangle begins, in area; infinite without it
  std::array<double, 2> area{};
};

struct SampledSegments {
  raycast::Segments16 segments;     // origins and directions alone
  std::array<double, 16> weight{};  // cos cos / r^2, softened; 0 below a horizon
};

// Numbers are those of the Random that is in `state` now; it has advanced by 64 after them. Segment i runs from cell i of p to cell
// opposite_cell(i, shift) of q.
inline constexpr std::uint64_t numbers_per_round = 64;
void draw_segments(const SamplePieces& p, const SamplePieces& q, std::uint64_t state, std::uint32_t shift, double softening,
                   SampledSegments& to, raycast::Isa set);

[[nodiscard]] constexpr std::uint32_t opposite_cell(std::uint32_t cell, std::uint32_t shift) { return (cell * 5u ^ shift) & 15u; }

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/segment_samples.cpp>
#endif
