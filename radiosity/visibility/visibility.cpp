// SPDX-License-Identifier: MIT
#include <radiosity/visibility/visibility.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/small_list.hpp>

#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/instruction_sets.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/segment_samples.hpp>

namespace radiosity {

HALFLIGHT_INLINE glm::dvec3 sample(const Patch& patch, double u, double v) {
  double rest = u * patch.area;
  const std::size_t parts = std::max<std::size_t>(1, patch.parts.size());
  for (std::size_t k = 0; k < parts; ++k) {
    const Polygon& q = patch.parts.empty() ? patch.contour : patch.parts[k];
    for (std::size_t i = 1; i + 1 < q.size(); ++i) {
      const double area = 0.5 * glm::dot(glm::cross(q[i] - q[0], q[i + 1] - q[0]), patch.normal);
      if (rest < area || (i + 2 == q.size() && k + 1 == parts)) {
        const double root = std::sqrt(std::clamp(area > 0.0 ? rest / area : 0.0, 0.0, 1.0));
        return q[0] + root * (1.0 - v) * (q[i] - q[0]) + root * v * (q[i + 1] - q[0]);
      }
      rest -= area;
    }
  }
  return patch.centre;
}

HALFLIGHT_INLINE ExposedPoints::ExposedPoints(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const Patch& patch,
                                              std::uint64_t key)
    : key_{key} {
  for (std::uint32_t i = 0; i < 256; ++i) {
    if (buried(scene, object, sheet, point(patch, i))) { continue; }
    blocks_[block_of(i)] = static_cast<std::uint16_t>(blocks_[block_of(i)] | 1u << bit_of(i));
    ++count_;
  }
}

HALFLIGHT_INLINE double ExposedPoints::share_above(const Patch& patch, const glm::dvec3& on, const glm::dvec3& normal) const {
  std::uint32_t above = 0, exposed = 0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    if (!(glm::dot(normal, point(patch, i) - on) > 0.0)) { continue; }
    ++above;
    exposed += blocks_[block_of(i)] >> bit_of(i) & 1u;
  }
  return above > 0 ? static_cast<double>(exposed) / above : count_ / 256.0;
}

HALFLIGHT_INLINE glm::dvec3 ExposedPoints::draw(const Patch& patch, std::uint32_t block, Random& random) const {
  const std::uint64_t bits = random.bits();
  if (blocks_[block] == 0) {
    std::uint32_t left = static_cast<std::uint32_t>(bits % count_);
    for (block = 0; left >= static_cast<std::uint32_t>(std::popcount(blocks_[block])); ++block) {
      left -= static_cast<std::uint32_t>(std::popcount(blocks_[block]));
    }
  }
  std::uint32_t chosen = blocks_[block];
  for (auto skip = static_cast<std::uint32_t>(bits >> 32) % static_cast<std::uint32_t>(std::popcount(chosen)); skip > 0; --skip) {
    chosen &= chosen - 1;
  }
  const auto bit = static_cast<std::uint32_t>(std::countr_zero(chosen));
  return point(patch, (block / 4 * 4 + bit / 4) * 16 + block % 4 * 4 + bit % 4);
}

HALFLIGHT_INLINE glm::dvec3 ExposedPoints::point(const Patch& patch, std::uint32_t i) const {
  Random random{key_, i};
  const double u = (i % 16 + random.uniform()) / 16.0;
  return sample(patch, u, (i / 16 + random.uniform()) / 16.0);
}

HALFLIGHT_INLINE glm::dvec3 draw_exposed(const PatchEnd& end, std::uint32_t cell, Random& random) {
  if (end.exposed != nullptr) { return end.exposed->draw(*end.patch, cell, random); }
  const double u = (cell % 4 + random.uniform()) / 4.0;
  return sample(*end.patch, u, (cell / 4 + random.uniform()) / 4.0);
}

HALFLIGHT_INLINE RayCount& RayCount::operator+=(const RayCount& other) {
  cast += other.cast;
  avoided += other.avoided;
  return *this;
}

// Counts segments that arrived, by the sixteenth of the patch in which they end.
class CellCounts {
 public:
  void add(std::uint32_t cell, bool clear) {
    ++all_[cell];
    if (clear) { ++clear_[cell]; }
  }
  // Standard deviation between the means of the cells, from which the noise p (1 - p) / (n - 1) of each mean is subtracted. Cells with a
  // single segment are ignored.
  [[nodiscard]] double spread() const {
    double n = 0.0, sum = 0.0, square = 0.0, noise = 0.0;
    for (std::size_t c = 0; c < 16; ++c) {
      if (all_[c] < 2) { continue; }
      const double mean = static_cast<double>(clear_[c]) / all_[c];
      n += 1.0;
      sum += mean;
      square += mean * mean;
      noise += mean * (1.0 - mean) / (all_[c] - 1.0);
    }
    if (n < 2.0) { return 0.0; }
    return std::sqrt(std::max(0.0, (square - sum * sum / n) / (n - 1.0) - noise / n));
  }

 private:
  std::array<std::uint16_t, 16> all_{}, clear_{};
};

// The corner of `patch` that is highest above the plane of `above`.
[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 highest_corner(const Patch& patch, const Patch& above) {
  const auto height = [&](const glm::dvec3& x) { return glm::dot(above.normal, x); };
  return *std::max_element(patch.contour.begin(), patch.contour.end(),
                           [&](const glm::dvec3& a, const glm::dvec3& b) { return height(a) < height(b); });
}

// Do the two corners that are highest above the other patch see each other? Used if no sample lies above both horizons.
[[nodiscard]] HALFLIGHT_INLINE bool highest_corners_clear(const SceneView& scene, const raycast::OccluderList& list,
                                                          const PatchPair& pair) {
  const auto& [p, q] = pair;
  const glm::dvec3 x = highest_corner(*p.patch, *q.patch);
  raycast::Segments16 segment;
  segment.set(0, {x, highest_corner(*q.patch, *p.patch) - x}, p.object, q.object, p.sheet, q.sheet);
  std::uint32_t last_occluder = raycast::no_shape;
  return scene.objects.occluded16(segment, list, last_occluder) == 0;
}

// Draws the segments of a round.
class Rounds {
 public:
  explicit Rounds(const PatchPair& pair) : pair_{pair}, softening_{0.01 * std::min(pair.p.patch->area, pair.q.patch->area)} {
    const auto& [p, q] = pair;
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      drawn_.segments.source[i] = p.object, drawn_.segments.target[i] = q.object;
      drawn_.segments.source_sheet[i] = p.sheet, drawn_.segments.target_sheet[i] = q.sheet;
    }
    if (whole(p) && whole(q)) { pieces_ = detail::SampledPair{detail::SamplePieces{*p.patch}, detail::SamplePieces{*q.patch}, softening_}; }
  }

  [[nodiscard]] const detail::SampledSegments& draw(Random& random, std::uint32_t shift) {
    raycast::Segments16& segments = drawn_.segments;
    if (pieces_) { detail::draw_segments(*pieces_, random.pass(detail::numbers_per_round), shift, drawn_, detail::instruction_set()); }
    std::uint32_t lanes = 0;  // lanes that may carry light
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      if (!pieces_) { draw(random, i, detail::opposite_cell(i, shift)); }
      lanes |= drawn_.weight[i] > 0.0 ? 1u << i : 0u;
    }
    segments.lanes = lanes;
    return drawn_;
  }

 private:
  [[nodiscard]] static bool whole(const PatchEnd& end) { return end.exposed == nullptr && detail::SamplePieces::fits(*end.patch); }

  void draw(Random& random, std::uint32_t i, std::uint32_t opposite) {
    const auto& [p, q] = pair_;
    const glm::dvec3 x = draw_exposed(p, i, random);
    const glm::dvec3 y = draw_exposed(q, opposite, random);
    const glm::dvec3 d = y - x;
    const double r2 = glm::dot(d, d) + softening_;
    drawn_.weight[i] = std::max(0.0, glm::dot(p.patch->normal, d)) * std::max(0.0, -glm::dot(q.patch->normal, d)) / (r2 * r2);
    drawn_.segments.set(i, {x, d}, p.object, q.object, p.sheet, q.sheet);
  }

  PatchPair pair_;
  double softening_;  // limits the weight of points that nearly touch
  std::optional<detail::SampledPair> pieces_;
  detail::SampledSegments drawn_;
};

// Results of the segments of a round, one bit each.
struct RoundSeen {
  std::uint32_t cast = 0, occluded = 0, shift = 0;
};

// Sets the spreads over both ends.
HALFLIGHT_INLINE void set_spreads(std::span<const RoundSeen> rounds, VisibilityEstimate& estimate) {
  CellCounts cells_p;
  CellCounts cells_q;
  for (const RoundSeen& round : rounds) {
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      if ((round.cast >> i & 1u) == 0) { continue; }
      const bool arrives = (round.occluded >> i & 1u) == 0;
      cells_p.add(i, arrives);
      cells_q.add(detail::opposite_cell(i, round.shift), arrives);
    }
  }
  estimate.spread_p = cells_p.spread();
  estimate.spread_q = cells_q.spread();
}

HALFLIGHT_INLINE double share_of_mixed(const WeighedSegments& first, const WeighedSegments& further, double count) {
  const auto mixed = [&](double share) { return 1.0 - std::pow(share, count) - std::pow(1.0 - share, count); };
  const double by_further = mixed(further.arrived / further.total), trust = by_further * by_further;
  const double share = (trust * first.arrived + further.arrived) / (trust * first.total + further.total);
  constexpr double least = 1e-9;
  if (share < least) { return 1.0 / count; }
  if (1.0 - share < least) { return 1.0 - 1.0 / count; }
  return (share - std::pow(share, count)) / mixed(share);
}

HALFLIGHT_INLINE VisibilityEstimate visibility(const SceneView& scene, const raycast::OccluderList& list, const PatchPair& pair,
                                               std::uint32_t rounds, Random random, std::vector<CastSegment>* seen) {
  VisibilityEstimate estimate;
  estimate.proven = list.clear();
  if (scene.plan.shortcuts && estimate.proven) {
    estimate.rays.avoided = segments_per_round;
    return estimate;
  }
  const raycast::OccluderList known = scene.plan.shortcuts ? list : raycast::OccluderList{};
  WeighedSegments first, further;  // of the rounds up to the one that could have been the last, and of those after it
  const std::uint32_t deciding = deciding_rounds(rounds);
  std::uint64_t decisive = 0;
  std::uint32_t blocked = 0;
  brep::SmallList<RoundSeen, 16> rounds_seen;
  std::uint32_t last_occluder = raycast::no_shape;
  Rounds source{pair};
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto shift = static_cast<std::uint32_t>(random.bits() & 15u);
    const auto& [segments, weights] = source.draw(random, shift);
    const std::uint32_t cast = segments.lanes;
    const std::uint32_t occluded = scene.objects.occluded16(segments, known, last_occluder) & cast;
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      if ((cast >> i & 1u) == 0) { continue; }
      const bool arrives = (occluded >> i & 1u) == 0;
      if (seen != nullptr) { seen->push_back({segments.at(i), arrives}); }
      WeighedSegments& sum = decisive > 0 ? further : first;
      sum.total += weights[i];
      sum.arrived += arrives ? weights[i] : 0.0;
    }
    estimate.rays.cast += static_cast<std::uint64_t>(std::popcount(cast));
    blocked += static_cast<std::uint32_t>(std::popcount(occluded));
    rounds_seen.push_back({cast, occluded, shift});
    const bool agree = blocked == 0 || blocked == estimate.rays.cast;
    if (decisive > 0 || round + 1 < deciding || estimate.rays.cast < std::uint64_t{deciding} * segments_per_round / 2) { continue; }
    if (agree) { break; }
    decisive = estimate.rays.cast;
  }
  if (blocked > 0 && blocked < estimate.rays.cast) { set_spreads({rounds_seen.data(), rounds_seen.size()}, estimate); }
  if (further.total > 0.0) {
    estimate.fraction = share_of_mixed(first, further, static_cast<double>(decisive));
    return estimate;
  }
  if (first.total > 0.0) {
    estimate.fraction = first.arrived / first.total;
    return estimate;
  }
  estimate.fraction = highest_corners_clear(scene, known, pair) ? 1.0 : 0.0;
  ++estimate.rays.cast;
  return estimate;
}

}  // namespace radiosity
