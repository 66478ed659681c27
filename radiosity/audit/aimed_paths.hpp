// SPDX-License-Identifier: MIT
#pragma once

// Decides whether the paths of an audit are aimed at bright places (PathTracer::aimed). In a room with a lamp in a shade, aiming reduces
// the variance to a tenth or less; where bright places matter little, it doubles the variance. So both tracers are tried at points drawn
// as in the audit. The audit itself then draws other points, because a choice made by looking at its own samples would bias it.

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

// Where a path begins, and its statistical weight.
struct PathStart {
  raycast::ScenePoint point;
  double weight = 1.0;
};

// An audit with fewer rays than this would be over before the trial has paid for itself.
inline constexpr std::uint64_t least_rays_to_aim = 2'000'000;

struct AimingTry {
  bool pays = false;
  std::uint64_t rays = 0;
};

// Is the variance of aimed paths clearly smaller for the same time? `start(i)` returns point i of `points`, or nothing if that
// point does not count.
template <class Start>
[[nodiscard]] AimingTry try_aiming(const PathTracer& plain, const PathTracer& aimed, std::uint64_t seed, std::uint32_t points,
                                   unsigned threads, const Start& start) {
  constexpr std::uint32_t paths = 32;
  // An aimed path takes about 1.4 times as long. Moreover, few points underestimate the variance of plain paths, which hit a place only
  // by chance.
  constexpr double least_gain = 2.0;
  const std::uint64_t own_seed = scramble(seed ^ 0x61696d696e67ull);  // other random numbers than those of the audit
  struct Point {
    double noise_plain = 0.0, noise_aimed = 0.0;
    std::uint64_t rays = 0;
  };
  std::vector<Point> tried(points);
  const auto measure = [&](std::size_t i) {
    const std::optional<PathStart> from = start(static_cast<std::uint32_t>(i));
    if (!from) { return; }
    const auto noise = [&](const PathTracer& tracer) {
      const PathEstimates light{own_seed, i, paths,
                                [&](PathNumbers& numbers) { return tracer.radiosity(from->point, numbers, tried[i].rays); }};
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
