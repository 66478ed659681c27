// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/geometric.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

// Independent estimates of the radiosity at a point, from low-discrepancy paths: four groups of paths, combined in pairs to two halves of
// `paths` paths each. `key` names the point. `trace(numbers)` traces one path and returns its light.
//
// The product of the errors of two independent estimates has no noise term on average. The mean over all six pairs of four groups has
// half the variance of the single product of the two halves.
struct PathEstimates {
  static constexpr std::uint32_t groups = 4;
  Color all[groups] = {};
  Color direct[groups] = {};  // the part that is emitted or was reflected once

  // `paths` must be even.
  template <class Trace>
  PathEstimates(std::uint64_t seed, std::uint64_t key, std::uint32_t paths, const Trace& trace) {
    const std::uint32_t own = paths / 2;
    for (std::uint64_t group = 0; group < groups; ++group) {
      const Sobol4 first{seed, 8 * key + 2 * group};
      const Sobol4 second{seed, 8 * key + 2 * group + 1};
      for (std::uint32_t k = 0; k < own; ++k) {
        PathNumbers numbers{first, second, k, Random{seed, key, group << 32 | k}};
        const PathTracer::Light light = trace(numbers);
        all[group] += light.all / static_cast<double>(own);
        direct[group] += light.direct / static_cast<double>(own);
      }
    }
  }

  [[nodiscard]] Color half(int which) const { return 0.5 * (all[2 * which] + all[2 * which + 1]); }

  // Unbiased estimate of the squared error of the radiosity `shown`, summed over the channels.
  [[nodiscard]] double square_off(const Color& shown) const {
    return of_pairs([&](std::uint32_t g) { return all[g] - shown; });
  }
  [[nodiscard]] double direct_square_off(const Color& shown) const {
    return of_pairs([&](std::uint32_t g) { return direct[g] - shown; });
  }
  [[nodiscard]] double other_square_off(const Color& shown) const {
    return of_pairs([&](std::uint32_t g) { return all[g] - direct[g] - shown; });
  }

  // Estimate of the noise of the groups in the variance of square_off(). With v the variance of a group, the mean of six products of two
  // errors has variance v^2 / 6; the square of the variance estimated from four groups is 5/3 v^2 on average.
  [[nodiscard]] double noise() const {
    const Color mean = 0.5 * (half(0) + half(1));
    double square = 0.0;
    for (const Color& group : all) { square += glm::dot(group - mean, group - mean) / (groups - 1); }
    return square * square / 10.0;
  }

 private:
  // The mean over all pairs of different groups.
  template <class Off>
  [[nodiscard]] static double of_pairs(const Off& off) {
    double sum = 0.0;
    for (std::uint32_t g = 0; g < groups; ++g) {
      for (std::uint32_t h = 0; h < g; ++h) { sum += glm::dot(off(g), off(h)); }
    }
    return sum / 6.0;
  }
};

}  // namespace radiosity
