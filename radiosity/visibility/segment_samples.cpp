// SPDX-License-Identifier: MIT
#include <radiosity/visibility/segment_samples.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/isa.hpp>

#ifdef HALFLIGHT_X86
#include <immintrin.h>
#endif

#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/instruction_sets.hpp>

#define HALFLIGHT_WIDE_FILE <radiosity/visibility/segment_samples.inc>
#include <radiosity/support/for_each_set.inc>

namespace radiosity::detail {

HALFLIGHT_INLINE SamplePieces::SamplePieces(const Patch& patch) : origin{patch.contour[0]}, normal{patch.normal}, whole{patch.area} {
  for (std::size_t i = 1; i < patch.contour.size(); ++i) { edges[i - 1] = patch.contour[i] - origin; }
  for (std::size_t k = 0; k < 2; ++k) { area[k] = 0.5 * glm::dot(glm::cross(edges[k], edges[k + 1]), normal); }
  split = patch.contour.size() == 3 ? std::numeric_limits<double>::infinity() : area[0];
}

HALFLIGHT_INLINE void draw_segments(const SampledPair& between, std::uint64_t state, std::uint32_t shift, SampledSegments& to,
                                    [[maybe_unused]] raycast::Isa set) {
  HALFLIGHT_BY_SET(set, draw_segments(between, state, shift, to));
}

}  // namespace radiosity::detail
