// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_goal.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::size_t Deadline::links_left(std::uint64_t links) const {
  if (!seconds_) { return std::numeric_limits<std::size_t>::max(); }
  constexpr double for_solution = 0.2;
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = (1.0 - for_solution) * *seconds_ - spent;
  return left > 0.0 ? static_cast<std::size_t>(left / spent * static_cast<double>(links)) : 0;
}

}  // namespace radiosity
