// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace test {

// The seed of a test's random numbers. Each run draws new ones; where the environment names one, HALFLIGHT_TEST_SEED, the first call
// returns that, each later call the next number. So a failure is repeated by the seed that it printed, and a run of all tests by the same
// seed (tests/run.sh) tells what changed, not what chance brought.
inline std::uint32_t seed() {
  static const char* const named = std::getenv("HALFLIGHT_TEST_SEED");
  static std::uint32_t calls = 0;
  if (named == nullptr || *named == '\0') { return std::random_device{}(); }
  return static_cast<std::uint32_t>(std::stoul(named)) + calls++;
}

}  // namespace test
