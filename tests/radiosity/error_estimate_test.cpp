// SPDX-License-Identifier: MIT

// The relative L2 error from samples with two independent estimates each: unbiased, and with an interval that noise does not close.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>

#include <radiosity/result/error_estimate.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "seed.hpp"

TEST_CASE("the error estimate is unbiased: it recovers an error that was put in") {
  std::uint64_t state = 77;
  INFO("seed 77");
  for (const double error : {0.0, 0.02, 0.2}) {
    radiosity::ErrorSums sums;
    radiosity::Random random{state++, 0};
    for (int i = 0; i < 20000; ++i) {
      // Truth 1, solution 1 + error, two estimates with independent noise of +-0.5.
      const double b1 = 0.5 + random.uniform();
      const double b2 = 0.5 + random.uniform();
      sums.add((b1 - 1.0 - error) * (b2 - 1.0 - error), b1 * b2, 0.0);
    }
    const auto estimate = sums.estimate();
    REQUIRE(estimate);
    CAPTURE(error, estimate->relative_l2, estimate->standard_error);
    CHECK(std::abs(estimate->relative_l2 - error) < 4.0 * estimate->standard_error);
  }
}

TEST_CASE("an error that is lost in the noise of few paths is never said to be none") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  constexpr double error = 0.05;
  int held = 0;
  for (int trial = 0; trial < 400; ++trial) {
    radiosity::ErrorSums sums;
    const auto estimate_of_one = [&] { return random.uniform() < 0.02 ? 50.0 : 0.0; };  // truth 1, seen by few paths
    for (int i = 0; i < 300; ++i) {
      const double b1 = estimate_of_one();
      const double b2 = estimate_of_one();
      sums.add((b1 - 1.0 - error) * (b2 - 1.0 - error), 1.0, 0.0);
    }
    const auto estimate = sums.estimate();
    REQUIRE(estimate);
    CHECK(estimate->high > 0.0);
    held += estimate->high >= error ? 1 : 0;
  }
  CHECK(held >= 372);  // 93 %
}

namespace {

// Points of very different brightness, each with an error of its own that is no part of how bright it is.
struct UnevenPoints {
  radiosity::ErrorSums sums;
  explicit UnevenPoints(std::mt19937& random, double spread, int count) {
    std::normal_distribution<double> normal;
    for (int i = 0; i < count; ++i) {
      const double light = std::exp(spread * normal(random)), error = 0.03 * std::exp(0.5 * normal(random));
      sums.add(light * error * error, light, 0.0);
    }
  }
};
const double rms_of_uneven = 0.03 * std::exp(0.25);  // RMS of a lognormal error of spread .5

}  // namespace

TEST_CASE("no interval is so narrow that one point decides it: it holds what all others tell without that one") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int trial = 0; trial < 300; ++trial) {
    const double spread = 3.0 * static_cast<double>(random() % 1000) / 1000.0;
    const radiosity::ErrorSums sums = UnevenPoints(random, spread, 100).sums;
    const auto estimate = sums.estimate();
    REQUIRE(estimate);
    const auto brightest = std::max_element(sums.reference.begin(), sums.reference.end()) - sums.reference.begin();
    const auto gone = static_cast<std::size_t>(brightest);
    const double squares = std::accumulate(sums.square.begin(), sums.square.end(), 0.0) - sums.square[gone];
    const double light = std::accumulate(sums.reference.begin(), sums.reference.end(), 0.0) - sums.reference[gone];
    CAPTURE(trial, spread, estimate->low, estimate->high);
    CHECK(estimate->low <= std::sqrt(squares / light));
    CHECK(estimate->high >= std::sqrt(squares / light));
  }
}

TEST_CASE("intervals hold the true error where few points are as bright as all others, too") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (const double spread : {0.0, 1.0, 2.0, 3.0}) {
    int held = 0;
    constexpr int trials = 1000;
    for (int trial = 0; trial < trials; ++trial) {
      const auto estimate = UnevenPoints(random, spread, 100).sums.estimate();
      REQUIRE(estimate);
      held += estimate->low <= rms_of_uneven && rms_of_uneven <= estimate->high ? 1 : 0;
    }
    CAPTURE(spread, held);
    // Errors of this kind are skewed beyond what 100 points show, and the brightest points are mostly not among them: that costs up to a
    // tenth of the intervals. Where the points counted as equally bright, 720 were right at a spread of 2, and 570 at 3.
    CHECK(held >= 0.8 * trials);
  }
}
