// SPDX-License-Identifier: MIT
#pragma once

// The fraction of the light between two patches that arrives (paper 4.3): segments between stratified points of both
// patches are tested against the original objects, never against the mesh. Each segment counts with the light it would
// carry. Where nothing can stand in between, no segment is cast (occlusion.hpp).
//
// Patches may be partly buried (a floor under a box): their points are drawn from the exposed part alone.

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

// A point of the patch, uniform in area for uniform (u, v); strata of (u, v) are strata of the patch.
[[nodiscard]] glm::dvec3 sample(const Patch& patch, double u, double v);

// Is this point of a sheet of the object hidden under or behind another object? The test is made on the true surface.
[[nodiscard]] inline bool buried(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const glm::dvec3& p) {
  const raycast::SurfacePoint surface = scene.object(object).project(sheet, p);
  return scene.covered(surface.position, surface.normal, object);
}

// Points of a patch that are known to be exposed: of one point in each cell of a 16 x 16 grid, those that are not buried.
class ExposedPoints {
 public:
  ExposedPoints() = default;
  // `key` names the patch: it fixes where in their cells the points lie.
  ExposedPoints(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const Patch& patch, std::uint64_t key);

  [[nodiscard]] std::uint32_t count() const { return count_; }

  // The share of the points above the plane through `on` with this normal that are exposed; of all points where none lies above.
  [[nodiscard]] double share_above(const Patch& patch, const glm::dvec3& on, const glm::dvec3& normal) const;

  // One of the points at random: in the given block of 4 x 4 cells, 0...15, if there is one, else anywhere. Requires a point.
  [[nodiscard]] glm::dvec3 draw(const Patch& patch, std::uint32_t block, Random& random) const;

 private:
  [[nodiscard]] static std::uint32_t block_of(std::uint32_t i) { return i / 64 * 4 + i % 16 / 4; }
  [[nodiscard]] static std::uint32_t bit_of(std::uint32_t i) { return i / 16 % 4 * 4 + i % 4; }
  [[nodiscard]] glm::dvec3 point(const Patch& patch, std::uint32_t i) const;

  std::uint64_t key_ = 0;
  std::uint32_t count_ = 0;
  std::array<std::uint16_t, 16> blocks_{};
};

// One end of a link as the visibility test sees it.
struct PatchEnd {
  const Patch* patch = nullptr;
  std::uint32_t object = 0;
  const ExposedPoints* exposed = nullptr;  // of a patch that is partly buried
  std::uint32_t sheet = raycast::unknown_sheet;
};

// A point of the exposed part of the end, in cell 0...15 of a 4 x 4 grid if that is exposed.
[[nodiscard]] glm::dvec3 draw_exposed(const PatchEnd& end, std::uint32_t cell, Random& random);

// Segments that were cast, and that were not because the answer was proven.
struct RayCount {
  std::uint64_t cast = 0, avoided = 0;
  RayCount& operator+=(const RayCount& other);
};

struct VisibilityEstimate {
  double fraction = 1.0;
  bool proven = false;  // nothing can stand between, whether segments were cast or not
  RayCount rays;
  // Standard deviation of the visible fraction from place to place on each patch, without the noise of sampling.
  double spread_p = 0.0, spread_q = 0.0;
};

inline constexpr std::uint32_t segments_per_round = 16;

// A segment that was cast and carries light if nothing stops it.
struct CastSegment {
  raycast::Segment segment;
  bool arrives = false;
};

// One round of 16 segments decides when they agree; else `rounds` rounds are averaged. So a patch of which the part p is hidden
// passes for wholly visible with probability (1 - p)^16, and the fraction is too large by p (1 - p)^16 <= 0.022 on average.
// The numbers drawn depend on `random` alone. `list` is that of the pair. The segments are added to `seen` when that is given.
[[nodiscard]] VisibilityEstimate visibility(const SceneView& scene, const raycast::OccluderList& list, const PatchEnd& p, const PatchEnd& q,
                                            std::uint32_t rounds, Random random, std::vector<CastSegment>* seen = nullptr);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/visibility.cpp>
#endif
