// SPDX-License-Identifier: MIT
#pragma once

// The fraction of the light between two patches that arrives (paper 4.3): segments between stratified points of both
// patches are tested against the original objects, never against the mesh. Each segment counts with the light it would
// carry. Where nothing can stand in between, no segment is cast.
//
// Patches may be partly buried (a floor under a box): their points are drawn from the exposed part alone.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <raycast/bundle.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/patch.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/random.hpp>

namespace radiosity {

// A point of the patch, uniform in area for uniform (u, v); strata of (u, v) are strata of the patch.
[[nodiscard]] inline glm::dvec3 sample(const Patch& patch, double u, double v) {
  const Polygon& q = patch.contour;
  double rest = u * patch.area;
  for (std::size_t i = 1; i + 1 < q.size(); ++i) {
    const double area = 0.5 * glm::dot(glm::cross(q[i] - q[0], q[i + 1] - q[0]), patch.normal);
    if (rest < area || i + 2 == q.size()) {
      const double root = std::sqrt(std::clamp(area > 0.0 ? rest / area : 0.0, 0.0, 1.0));
      return q[0] + root * (1.0 - v) * (q[i] - q[0]) + root * v * (q[i + 1] - q[0]);
    }
    rest -= area;
  }
  return patch.centre;
}

// Is this point of a sheet of the object hidden under or behind another object? The test is made on the true surface.
[[nodiscard]] inline bool buried(const raycast::Scene& scene, std::uint32_t object, std::uint32_t sheet, const glm::dvec3& p) {
  const raycast::SurfacePoint surface = scene.object(object).project(sheet, p);
  return scene.covered(surface.position, surface.normal, object);
}

// One end of a link as the visibility test sees it.
struct PatchEnd {
  const Patch* patch = nullptr;
  std::uint32_t object = 0;
  std::uint32_t sheet = 0;
  bool partly_buried = false;
};

// Draws a point of the exposed part of the end; the first attempt lies in cell 0...15 of a 4 x 4 grid. False when none is found.
[[nodiscard]] inline bool draw_exposed(const raycast::Scene& scene, const PatchEnd& end, std::uint32_t cell, Random& random,
                                       glm::dvec3& x) {
  for (int attempt = 0; attempt < 16; ++attempt) {
    const double u = attempt == 0 ? (cell % 4 + random.uniform()) / 4.0 : random.uniform();
    const double v = attempt == 0 ? (cell / 4 + random.uniform()) / 4.0 : random.uniform();
    x = sample(*end.patch, u, v);
    if (!end.partly_buried || !buried(scene, end.object, end.sheet, x)) { return true; }
  }
  return false;
}

struct VisibilityEstimate {
  double fraction = 1.0;
  std::uint32_t rays = 0;
  // Standard deviation of the visible fraction from place to place on each patch, without the noise of sampling.
  double spread_p = 0.0, spread_q = 0.0;
};

// Segments that arrived, by the sixteenth of the patch where they end.
class CellCounts {
 public:
  void add(std::uint32_t cell, bool clear) {
    ++all_[cell];
    if (clear) { ++clear_[cell]; }
  }
  // Between the means of the cells; the noise p (1 - p) / (n - 1) of each mean is taken off. Cells of one segment do not count.
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

inline constexpr std::uint32_t segments_per_round = 16;

// One round of 16 segments decides when they agree; else `rounds` rounds are averaged. So a patch of which the part p is hidden
// passes for wholly visible with probability (1 - p)^16, and the fraction is too large by p (1 - p)^16 <= 0.022 on average.
// The numbers drawn depend on `random` alone.
[[nodiscard]] inline VisibilityEstimate visibility(const raycast::Scene& scene, const Plan& plan, const PatchEnd& p, const PatchEnd& q,
                                                   std::uint32_t rounds, Random random) {
  raycast::Box hull{p.patch->contour[0], p.patch->contour[0]};
  for (const Patch* patch : {p.patch, q.patch}) {
    for (const glm::dvec3& x : patch->contour) {
      hull.lo = glm::min(hull.lo, x);
      hull.hi = glm::max(hull.hi, x);
    }
  }
  if (!may_block(plan, p.object, q.object, hull)) { return {}; }

  VisibilityEstimate estimate;
  const double softening = 0.01 * std::min(p.patch->area, q.patch->area);  // bounds the weight of touching points
  double total = 0.0;
  double arrived = 0.0;
  std::uint32_t clear = 0;
  std::uint32_t blocked = 0;
  CellCounts cells_p;
  CellCounts cells_q;
  std::uint32_t last_occluder = raycast::no_shape;
  const auto opposite = [](std::uint32_t cell, std::uint32_t shift) { return (cell * 5u ^ shift) & 15u; };
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto shift = static_cast<std::uint32_t>(random.bits() & 15u);
    raycast::Segments16 segments;
    std::array<double, segments_per_round> weights{};
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      glm::dvec3 x{0.0};
      glm::dvec3 y{0.0};
      if (!draw_exposed(scene, p, i, random, x) || !draw_exposed(scene, q, opposite(i, shift), random, y)) { continue; }
      const glm::dvec3 d = y - x;
      const double r2 = glm::dot(d, d) + softening;
      weights[i] = std::max(0.0, glm::dot(p.patch->normal, d)) * std::max(0.0, -glm::dot(q.patch->normal, d)) / (r2 * r2);
      if (weights[i] > 0.0) { segments.set(i, {x, d}, p.object, q.object); }
    }
    const std::uint32_t occluded = scene.occluded16(segments, last_occluder);
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      if (!(weights[i] > 0.0)) { continue; }
      const bool arrives = (occluded >> i & 1u) == 0;
      total += weights[i];
      arrived += arrives ? weights[i] : 0.0;
      ++estimate.rays;
      ++(arrives ? clear : blocked);
      cells_p.add(i, arrives);
      cells_q.add(opposite(i, shift), arrives);
    }
    if (clear + blocked >= segments_per_round / 2 && (clear == 0 || blocked == 0)) { break; }
  }
  if (clear > 0 && blocked > 0) {
    estimate.spread_p = cells_p.spread();
    estimate.spread_q = cells_q.spread();
  }
  estimate.fraction = total > 0.0 ? arrived / total : 1.0;  // no sample above both horizons: nothing is known to block
  return estimate;
}

}  // namespace radiosity
