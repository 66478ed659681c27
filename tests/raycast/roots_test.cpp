// SPDX-License-Identifier: MIT
// Zeros of functions on an interval: how many values they take, and how near they come.

#include "primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <raycast/roots.hpp>

using namespace raycast;
using namespace test;

TEST_CASE("a zero beside a cusp takes forty values at most, however near it is, and is as exact as the numbers around it") {
  SEEDED(random);
  int most = 0;
  double sum = 0.0;
  constexpr int trials = 5000;
  for (int i = 0; i < trials; ++i) {
    // (distance from an end of the interval)^p less that of the zero: p = 0.2 is the blade of a superquadric of exponent 10.
    const double p = std::pow(10.0, random.uniform(-1.0, 0.0)), at = random.uniform(-1.0, 1.0), length = random.uniform(0.1, 2.0);
    const double zero = length * std::min(0.999, std::pow(10.0, random.uniform(-14.0, 0.0))), level = std::pow(zero / length, p);
    if (!(level > 1e-300)) { continue; }
    const bool mirrored = random.uniform(0.0, 1.0) < 0.5, rising = random.uniform(0.0, 1.0) < 0.5;
    const double rounding = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : 4.0 * std::numeric_limits<double>::epsilon();
    int values = 0;
    const auto f = [&](double s) {
      ++values;
      const double distance = std::max(0.0, mirrored ? at + length - s : s - at), sign = rising != mirrored ? 1.0 : -1.0;
      const double noise = rounding * level * random.uniform(-1.0, 1.0);
      const double value = std::pow(distance / length, p) - level + noise;
      return Sample{sign * value, (rising ? 1.0 : -1.0) * p * std::pow(distance / length, p - 1.0) / length};
    };
    const double found = bracketed_root(f, at, at + length, rising, at + length * random.uniform(0.02, 0.98));
    const double wanted = mirrored ? at + length - zero : at + zero, epsilon = std::numeric_limits<double>::epsilon();
    INFO(i << " p " << p << " at " << at << " length " << length << " zero " << zero << " mirrored " << mirrored << " values " << values);
    // Two units of the larger end, the rounding of at + length, of the powers and of `noise` by the slope at the zero.
    CHECK(std::abs(found - wanted) <=
          8.0 * epsilon * std::max(std::abs(at), std::abs(at + length)) + 16.0 * epsilon * zero * (1.0 + 1.0 / p));
    CHECK(values <= 40);
    most = std::max(most, values);
    sum += values;
  }
  INFO("values: most " << most << ", mean " << sum / trials);
  CHECK(sum / trials <= 20.0);
}
