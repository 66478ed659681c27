// SPDX-License-Identifier: MIT
#pragma once

// Whether an audit's paths are to be aimed at bright places (PathTracer::aimed). In a room with a lamp in a shade that makes the variance a
// tenth or less; where these places matter little it doubles it. So both are tried at points such as the audit draws, and the audit draws
// others: what a try has found must not count.

#include <cmath>
#include <cstdint>
#include <optional>

#include <raycast/object.hpp>

#include <radiosity/audit/path_estimates.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

// A point of a surface, and how much it counts.
struct PathStart {
  raycast::SurfacePoint point;
  std::uint32_t object = 0, sheet = 0;
  double weight = 1.0;
};

// An audit of fewer rays ends before a try has paid.
inline constexpr std::uint64_t least_rays_to_aim = 2'000'000;

// Do aimed paths tell clearly more for the same time? `start(i)`: point i of `points`, if it counts.
template <class Start>
[[nodiscard]] bool aiming_pays(const PathTracer& plain, const PathTracer& aimed, std::uint64_t seed, std::uint32_t points,
                               const Start& start) {
  constexpr std::uint32_t paths = 32;
  // An aimed path takes about 1.4 times as long. A few points tell the variance that paths meet by chance mostly too small.
  constexpr double least_gain = 2.0;
  double plainly = 0.0, aiming = 0.0;
  for (std::uint32_t i = 0; i < points; ++i) {
    const std::optional<PathStart> from = start(i);
    if (!from) { continue; }
    const auto variance = [&](const PathTracer& tracer) {
      std::uint64_t rays = 0;
      const PathEstimates light{seed, i, paths, [&](PathNumbers& numbers) {
                                  return tracer.radiosity(from->point.position, from->point.normal, from->object, from->sheet, numbers,
                                                          rays);
                                }};
      return from->weight * std::sqrt(light.noise());
    };
    plainly += variance(plain);
    aiming += variance(aimed);
  }
  return least_gain * aiming < plainly;
}

}  // namespace radiosity
