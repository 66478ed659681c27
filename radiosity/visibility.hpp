// SPDX-License-Identifier: MIT
#pragma once

// The fraction of the light between two patches that arrives (paper 4.3): segments between stratified points of both
// patches are tested against the original objects, never against the mesh. Each segment counts with the light it would
// carry. Where nothing can stand in between, no segment is cast.
//
// Patches may be partly buried (a floor under a box): their points are drawn from the exposed part alone.

#include <algorithm>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto shift = static_cast<std::uint32_t>(random.bits() & 15u);
    for (std::uint32_t i = 0; i < segments_per_round; ++i) {
      glm::dvec3 x{0.0};
      glm::dvec3 y{0.0};
      if (!draw_exposed(scene, p, i, random, x) || !draw_exposed(scene, q, (i * 5u ^ shift) & 15u, random, y)) { continue; }
      const glm::dvec3 d = y - x;
      const double r2 = glm::dot(d, d) + softening;
      const double weight = std::max(0.0, glm::dot(p.patch->normal, d)) * std::max(0.0, -glm::dot(q.patch->normal, d)) / (r2 * r2);
      if (!(weight > 0.0)) { continue; }
      total += weight;
      ++estimate.rays;
      if (scene.occluded({x, d}, p.object, q.object)) {
        ++blocked;
      } else {
        ++clear;
        arrived += weight;
      }
    }
    if (clear + blocked >= segments_per_round / 2 && (clear == 0 || blocked == 0)) { break; }
  }
  estimate.fraction = total > 0.0 ? arrived / total : 1.0;  // no sample above both horizons: nothing is known to block
  return estimate;
}

}  // namespace radiosity
