// SPDX-License-Identifier: MIT
// libFuzzer target: the input chooses solids on few grid points and the operations on them; the laws of set algebra are the oracle, and
// every result is valid (tests/brep/csg_random.hpp).

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "csg_random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::size_t at = 0;
  const auto below = [&](int n) {
    if (n > 256) {  // where to look for the points of the oracle: nothing worth searching
      static_assert(sizeof(std::uint32_t) == 4);
      const std::uint32_t mixed = static_cast<std::uint32_t>(++at) * 2654435761u;
      return static_cast<int>((mixed >> 8) % static_cast<std::uint32_t>(n));
    }
    return at < size ? data[at++] % n : 0;
  };
  const int grid_points = 1 + below(4), depth = 1 + below(4);
  const std::string wrong = solids::random_laws(below, grid_points, depth);
  if (wrong.empty()) { return 0; }
  std::fprintf(stderr, "broken: %s\n", wrong.c_str());
  std::abort();
}
