// SPDX-License-Identifier: MIT
#include <radiosity/support/memory.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include <sys/resource.h>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<std::uint64_t> peak_memory() {
#if defined(HALFLIGHT_HAS_RUSAGE)
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0 || usage.ru_maxrss <= 0) { return std::nullopt; }
#if defined(__APPLE__)
  constexpr std::uint64_t unit = 1;
#else
  constexpr std::uint64_t unit = 1024;
#endif
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
#else
  return std::nullopt;
#endif
}

HALFLIGHT_INLINE std::string memory_text(std::uint64_t bytes) {
  char text[32] = "";
  const auto value = static_cast<double>(bytes);
  std::snprintf(text, sizeof text,
                value < 1e6   ? "%.3g kB"
                : value < 1e9 ? "%.3g MB"
                              : "%.3g GB",
                value / (value < 1e6   ? 1e3
                         : value < 1e9 ? 1e6
                                       : 1e9));
  return text;
}

HALFLIGHT_INLINE std::uint64_t MemoryBudget::peak(const Counts& counts) const {
  constexpr std::uint64_t node = 2400, link = 48, shape = 130, pair = 30, ray = 150, list = 264, batch = 1 << 14;
  const std::uint64_t counted = fixed + node * counts.nodes + (link + (a_posteriori ? shape : 0)) * counts.links + pair * counts.pairs +
                                list * std::min(batch, counts.pairs) + 2 * counts.occluders + ray * counts.rays;
  return counted + counted / 100;  // tables of few rows take somewhat more than their rows
}

}  // namespace radiosity
