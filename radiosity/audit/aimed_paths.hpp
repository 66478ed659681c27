// SPDX-License-Identifier: MIT
#pragma once

// Whether an audit's paths are to be aimed at bright places (PathTracer::aimed). In a room with a lamp in a shade that makes the variance a
// tenth or less; where these places matter little it doubles it. So both are tried at points such as the audit draws, and the audit draws
// others: what a try has found must not count.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <raycast/object.hpp>

#include <radiosity/audit/path_estimates.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
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

struct AimingTry {
  bool pays = false;
  std::uint64_t rays = 0;
};

// Do aimed paths tell clearly more for the same time? `start(i)`: point i of `points`, if it counts.
template <class Start>
[[nodiscard]] AimingTry try_aiming(const PathTracer& plain, const PathTracer& aimed, std::uint64_t seed, std::uint32_t points,
                                   unsigned threads, const Start& start) {
  constexpr std::uint32_t paths = 32;
  // An aimed path takes about 1.4 times as long, and from few points the variance of paths that find a place by chance looks too small.
  constexpr double least_gain = 2.0;
  const std::uint64_t own_seed = scramble(seed ^ 0x61696d696e67ull);  // paths that the audit does not trace
  struct Point {
    double noise_plain = 0.0, noise_aimed = 0.0;
    std::uint64_t rays = 0;
  };
  std::vector<Point> tried(points);
  const auto measure = [&](std::size_t i) {
    const std::optional<PathStart> from = start(static_cast<std::uint32_t>(i));
    if (!from) { return; }
    const auto noise = [&](const PathTracer& tracer) {
      const PathEstimates light{own_seed, i, paths, [&](PathNumbers& numbers) {
                                  return tracer.radiosity(from->point.position, from->point.normal, from->object, from->sheet, numbers,
                                                          tried[i].rays);
                                }};
      return from->weight * std::sqrt(light.noise());
    };
    tried[i].noise_plain = noise(plain);
    tried[i].noise_aimed = noise(aimed);
  };
  parallel_for(points, threads, measure, 1);
  double noise_plain = 0.0, noise_aimed = 0.0;
  AimingTry result;
  for (const Point& point : tried) {
    noise_plain += point.noise_plain;
    noise_aimed += point.noise_aimed;
    result.rays += point.rays;
  }
  result.pays = least_gain * noise_aimed < noise_plain;
  return result;
}

}  // namespace radiosity
