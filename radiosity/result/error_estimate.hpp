// SPDX-License-Identifier: MIT
#pragma once

// A relative L2 error estimated from samples, with an interval that contains the true error in 95 of 100 cases.
//
// At N random points (of the surfaces, or of a picture) two independent estimates b1, b2 of the true radiosity are made. The mean of (b1
// - B)(b2 - B) is an unbiased estimate of the mean squared error of B, because the noise of b1 and b2 is independent. It is divided by
// the mean square of the reflected radiosity B - E, which is estimated in the same unbiased way. (Emitted light is exact by definition
// and must not make the error look smaller.)

#include <cstdint>
#include <optional>
#include <vector>

namespace radiosity {

struct ErrorEstimate {
  double relative_l2 = 0.0;      // RMS error / RMS reflected radiosity; all channels together
  double standard_error = 0.0;   // of relative_l2
  double low = 0.0, high = 0.0;  // the 95 % interval; low is 0 if the noise hides the error

  // Is the error, with the certainty of the interval, at most or above `wanted`?
  [[nodiscard]] bool within(double wanted) const { return high <= wanted; }
  [[nodiscard]] bool above(double wanted) const { return low > wanted; }
};

// Errors below this need not be known more precisely: no audit is enlarged for it.
inline constexpr double negligible_error = 0.005;

// Is the interval wider than the error itself, or the error hidden by noise?
[[nodiscard]] inline bool is_wide(const ErrorEstimate& error) {
  return error.high > 0.0 && (error.low <= 0.0 || error.high - error.low > error.relative_l2);
}

// Samples of the two mean squares, one per point.
struct ErrorSums {
  std::vector<double> square, reference;  // (b1 - B)(b2 - B) and (b1 - E)(b2 - E)
  double noise = 0.0;                     // contribution of the noise of b1 and b2 to the variance of `square`, summed over the points

  void add(double of_square, double of_reference, double of_noise);

  // Moments for the ratio R of both means: R, and the variance and skewness of square - R * reference over the points, relative to the
  // mean of `reference`. A point that outshines the others pulls R to its own ratio and would seem to have no deviation; so the deviation
  // of each point is taken from the ratio of all other points (jackknife, Tukey 1958). Nothing with fewer than two points, or if they see
  // no light.
  struct Moments {
    double ratio = 0.0, variance = 0.0, skewness = 0.0;
    double noise_share = 0.0;   // share of the variance that is noise
    double equal_points = 0.0;  // this many equally bright points would determine the variance as well (Kish 1965)
  };
  [[nodiscard]] std::optional<Moments> moments() const;

  // Squared errors are skewed: most are small, a few large. So the interval is the usual one for the mean after a cubic transformation
  // that removes the skewness (Hall 1992); it extends further towards larger errors, which chance may have missed. Student's quantiles
  // are used, because few points determine their own variance poorly.
  [[nodiscard]] std::optional<ErrorEstimate> estimate() const;
};

// A share that noise leaves uncertain.
struct ShareBounds {
  double least = 0.0, most = 0.0;
};

// The error of a picture (picture_error.hpp).
struct PictureError {
  ErrorEstimate error;       // relative L2 over the visible pixels without lamps
  double audited = 0.0;      // share of all pixels that are visible and show no lamp
  ShareBounds over2, over8;  // share of those with a channel more than 2, or 8, of 255 levels off
  // Of 4 x 4 tiles, those with at least 16 of the pixels are compared; the one with the largest lower bound of its error. Same unit.
  // Nothing if most of the error is in other tiles.
  struct Tile {
    std::uint32_t column = 0, row = 0;
    ErrorEstimate error;
  };
  std::optional<Tile> worst;
  std::uint64_t points = 0, rays = 0;     // rays: including pilots
  std::uint64_t reserve_used = 0;         // of AuditGoal::reserve, in path-tracing rays among few polygons
  std::uint64_t picture_work = 0;         // approximate work of the picture, in the same unit
  std::optional<ErrorEstimate> steering;  // from points and paths whose number does not depend on the wanted error
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/error_estimate.cpp>
#endif
