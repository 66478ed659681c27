// SPDX-License-Identifier: MIT
#pragma once

// The fraction of the light between two patches that is not blocked (paper 4.3): segments between stratified points of both
// patches are tested against the original objects, never against the mesh. Each segment is weighted with the light that it
// would carry. If nothing can stand in between, no segment is cast (occlusion.hpp).
//
// Patches may be partly buried (a floor under a box); their points are drawn from the exposed part only.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// A point of the patch, uniform by area for uniform (u, v); strata of (u, v) are strata of the patch.
[[nodiscard]] glm::dvec3 sample(const Patch& patch, double u, double v);

// Is this point of a sheet hidden under or behind another object? Tested on the true surface.
[[nodiscard]] inline bool buried(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const glm::dvec3& p) {
  const raycast::SurfacePoint surface = scene.object(object).project(sheet, p);
  return scene.covered(surface.position, surface.normal, object);
}

// Points of a patch that are known to be exposed: of one point in each cell of a 16 x 16 grid, those that are not buried.
class ExposedPoints {
 public:
  ExposedPoints() = default;
  // `key` names the patch and determines the positions of the points within their cells.
  ExposedPoints(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const Patch& patch, std::uint64_t key);

  [[nodiscard]] std::uint32_t count() const { return count_; }

  // Share of exposed points among those above the plane through `on` with this normal; among all points if none lies above.
  [[nodiscard]] double share_above(const Patch& patch, const glm::dvec3& on, const glm::dvec3& normal) const;

  // A random one of the points: in the given block of 4 x 4 cells, 0...15, if it has any, otherwise anywhere. Requires count() > 0.
  [[nodiscard]] glm::dvec3 draw(const Patch& patch, std::uint32_t block, Random& random) const;

 private:
  [[nodiscard]] static std::uint32_t block_of(std::uint32_t i) { return i / 64 * 4 + i % 16 / 4; }
  [[nodiscard]] static std::uint32_t bit_of(std::uint32_t i) { return i / 16 % 4 * 4 + i % 4; }
  [[nodiscard]] glm::dvec3 point(const Patch& patch, std::uint32_t i) const;

  std::uint64_t key_ = 0;
  std::uint32_t count_ = 0;
  std::array<std::uint16_t, 16> blocks_{};
};

// One end of a link, for the visibility test.
struct PatchEnd {
  const Patch* patch = nullptr;
  std::uint32_t object = 0;
  const ExposedPoints* exposed = nullptr;  // if the patch is partly buried
  std::uint32_t sheet = raycast::unknown_sheet;
};

struct PatchPair {
  PatchEnd p, q;
};

// A point of the exposed part of the end, in cell 0...15 of a 4 x 4 grid if that has exposed points.
[[nodiscard]] glm::dvec3 draw_exposed(const PatchEnd& end, std::uint32_t cell, Random& random);

// Numbers of segments that were cast, and that were avoided by proof.
struct RayCount {
  std::uint64_t cast = 0, avoided = 0;
  RayCount& operator+=(const RayCount& other);
};

struct VisibilityEstimate {
  double fraction = 1.0;
  bool proven = false;  // is it proven that nothing can stand between, whether or not segments were cast?
  RayCount rays;
  // Standard deviation of the visible fraction over each patch, without the noise of sampling.
  double spread_p = 0.0, spread_q = 0.0;
};

inline constexpr std::uint32_t segments_per_round = 16;

// A segment that was cast and would carry light.
struct CastSegment {
  raycast::Segment segment;
  bool arrives = false;
};

// The visible share of a pair by several rounds of segments, of which the first ones are all if their `count` segments all arrive or
// none do. A share p above 0 then passes as 0 with probability (1 - p)^count, which would make rooms dark that are lit through small
// windows: of p = 0.02, 16 segments miss three quarters. So where the first rounds were mixed, the result is larger by as much as is lost
// on average where they were not (likewise for shares close to 1). They are mixed more often the more of their segments arrive by
// chance, so they count for little unless they would be mixed almost always; `further`: the sums of all other rounds.
struct WeighedSegments {
  double total = 0.0, arrived = 0.0;
};
[[nodiscard]] double share_of_mixed(const WeighedSegments& first, const WeighedSegments& further, double count);

// How many of `rounds` rounds decide if all of their segments agree.
[[nodiscard]] inline std::uint32_t deciding_rounds(std::uint32_t rounds) { return std::max(1u, rounds / 4); }

// Casts rounds of 16 segments. If all segments of the deciding rounds agree, these are enough; otherwise `rounds` rounds are cast
// (share_of_mixed). The mean over seeds is the true fraction up to a bias, because the segments of a round are stratified and not
// independent; the bias found was at most 25 % of the visible or the hidden share, whichever is smaller. The numbers drawn depend on
// `random` alone. `list`: that of the pair. `seen`, if given, receives the segments.
[[nodiscard]] VisibilityEstimate visibility(const SceneView& scene, const raycast::OccluderList& list, const PatchPair& pair,
                                            std::uint32_t rounds, Random random, std::vector<CastSegment>* seen = nullptr);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/visibility.cpp>
#endif
