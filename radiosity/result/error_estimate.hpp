// SPDX-License-Identifier: MIT
#pragma once

// A relative L2 error from samples, with an interval that holds the truth in 95 of 100 cases.
//
// At N random points (of the surfaces, or of a picture) two independent estimates b1, b2 of the true radiosity are made; the mean of
// (b1 - B)(b2 - B) is an unbiased estimate of the mean squared error of B, because the noise of b1 and b2 is independent. It is
// given relative to the mean square of the reflected radiosity B - E (a lamp is exact by definition and must not flatter the figure),
// estimated without bias in the same way.

#include <cstdint>
#include <optional>
#include <vector>

namespace radiosity {

struct ErrorEstimate {
  double relative_l2 = 0.0;      // RMS error / RMS reflected radiosity; all channels together
  double standard_error = 0.0;   // of relative_l2
  double low = 0.0, high = 0.0;  // the 95 % interval; low is 0 where the noise hides the error

  // Is the error known to be at most, or above, `wanted`?
  [[nodiscard]] bool within(double wanted) const { return high <= wanted; }
  [[nodiscard]] bool above(double wanted) const { return low > wanted; }
};

// An error that need not be known any closer: no audit is made larger for it.
inline constexpr double negligible_error = 0.005;

// Is the interval of the error wider than the error itself, or is the error lost in the noise?
[[nodiscard]] inline bool is_wide(const ErrorEstimate& error) {
  return error.high > 0.0 && (error.low <= 0.0 || error.high - error.low > error.relative_l2);
}

// Samples of the two mean squares, one a point.
struct ErrorSums {
  std::vector<double> square, reference;  // (b1 - B)(b2 - B) and (b1 - E)(b2 - E)
  double noise = 0.0;                     // what the noise of b1 and b2 adds to the variance of `square`, summed over the points

  void add(double of_square, double of_reference, double of_noise);

  // Of the ratio R of both means: mean, the variance and the skewness of square - R reference from point to point, relative to the mean
  // of `reference`. A point that outshines the others draws R to its own ratio and seems to lie right on it; so each counts as far off as
  // it is from the ratio of all others (jackknife, Tukey 1958). Nothing with fewer than two points, or when they see no light.
  struct Moments {
    double ratio = 0.0, variance = 0.0, skewness = 0.0;
    double noise_share = 0.0;   // of the variance
    double equal_points = 0.0;  // that many equally bright points would tell as much about the variance (Kish 1965)
  };
  [[nodiscard]] std::optional<Moments> moments() const;

  // Squared errors are skewed: most are small, a few large. So the interval is the usual one for the mean after a cubic transformation
  // that takes the skewness out of it (Hall 1992), and leans to the side of the larger errors that were not met by chance. It has Student's
  // quantiles, for few points know little about their own variance.
  [[nodiscard]] std::optional<ErrorEstimate> estimate() const;
};

// A share of which the noise leaves open how large it is.
struct ShareBounds {
  double least = 0.0, most = 0.0;
};

// Of a picture (picture_error.hpp).
struct PictureError {
  ErrorEstimate error;       // relative L2 over the visible pixels without lamps
  double audited = 0.0;      // share of all pixels that are visible and without lamps
  ShareBounds over2, over8;  // share of those in which a channel is more than 2, 8 of 255 levels off
  // Of the tiles of 4 x 4 that have at least 16 of the pixels, the one with the largest lower bound of its error; in the same unit.
  struct Tile {
    std::uint32_t column = 0, row = 0;
    ErrorEstimate error;
  };
  std::optional<Tile> worst;
  std::uint64_t points = 0, rays = 0;     // rays of its pilots, too
  std::uint64_t picture_work = 0;         // about what the picture took, in rays of paths among few polygons
  std::optional<ErrorEstimate> steering;  // from points and paths whose number does not depend on what is wanted
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/error_estimate.cpp>
#endif
