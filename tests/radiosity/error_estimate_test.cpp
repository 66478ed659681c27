// SPDX-License-Identifier: MIT

// The relative L2 error from samples with two independent estimates each: unbiased, and with an interval that noise does not close.

#include <cmath>
#include <cstdint>
#include <random>

#include <radiosity/result/error_estimate.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"

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
  const auto seed = std::random_device{}();
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
