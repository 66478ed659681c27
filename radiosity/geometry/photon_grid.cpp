// SPDX-License-Identifier: MIT
#include <radiosity/geometry/photon_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::uint32_t photon_grids = 4;          // each with cells twice as wide as the one before
inline constexpr double finest_photon_cell = 1.0 / 64.0;  // relative to the diameter of the scene
inline constexpr double most_trust = 0.875;               // below 1, because photons may miss sources that shine past an edge
inline constexpr std::size_t least_photons = 16;          // least number of photons in a cell that is used

[[nodiscard]] HALFLIGHT_INLINE std::uint64_t photon_cell(std::uint32_t grid, double width, const glm::dvec3& position,
                                                         const glm::dvec3& normal) {
  const std::array<double, 3> size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const auto axis = std::max_element(size.begin(), size.end()) - size.begin();
  const bool backwards = std::signbit(normal[static_cast<int>(axis)]);
  std::uint64_t key = scramble(8 * std::uint64_t{grid} + 2 * static_cast<std::uint64_t>(axis) + (backwards ? 1 : 0));
  for (int k = 0; k < 3; ++k) {
    key = scramble(key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(position[k] / width))));
  }
  return key;
}

}  // namespace detail

HALFLIGHT_INLINE PhotonGrid::PhotonGrid(std::span<const Photon> photons, double diameter) : width_{detail::finest_photon_cell * diameter} {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;  // cell and source
  for (std::uint32_t grid = 0; grid < detail::photon_grids; ++grid) {
    const double width = std::ldexp(width_, static_cast<int>(grid));
    for (const Photon& photon : photons) {
      entries.emplace_back(detail::photon_cell(grid, width, photon.position, photon.normal), photon.source);
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
    const std::uint64_t cell = entries[first].first;
    while (last < entries.size() && entries[last].first == cell) { ++last; }
    if (last - first < detail::least_photons) { continue; }
    const std::size_t begin = shares_.size();
    const double photons_here = static_cast<double>(last - first);
    for (std::size_t i = first; i < last; ++i) {
      if (i == first || entries[i].second != entries[i - 1].second) { shares_.push_back({entries[i].second, 0.0}); }
      shares_.back().share += 1.0 / photons_here;
    }
    // The probability that the next photon comes from a source not yet seen here is about the share of sources seen exactly
    // once (Good 1953).
    const auto once = std::count_if(shares_.begin() + static_cast<std::ptrdiff_t>(begin), shares_.end(),
                                    [&](const Share& s) { return s.share < 1.5 / photons_here; });
    cells_[cell] = {begin, shares_.size(), detail::most_trust * (1.0 - static_cast<double>(once) / photons_here)};
  }
}

HALFLIGHT_INLINE PhotonGrid::Around PhotonGrid::around(const glm::dvec3& position, const glm::dvec3& normal) const {
  for (std::uint32_t grid = 0; grid < detail::photon_grids && !cells_.empty(); ++grid) {
    const auto found = cells_.find(detail::photon_cell(grid, std::ldexp(width_, static_cast<int>(grid)), position, normal));
    if (found == cells_.end()) { continue; }
    const Cell& cell = found->second;
    return {std::span{shares_}.subspan(cell.first, cell.last - cell.first), cell.trust};
  }
  return {};
}

HALFLIGHT_INLINE double PhotonGrid::Around::share_of(std::uint32_t source) const {
  const auto at = std::lower_bound(shares.begin(), shares.end(), source, [](const Share& s, std::uint32_t of) { return s.source < of; });
  return at != shares.end() && at->source == source ? at->share : 0.0;
}

HALFLIGHT_INLINE std::uint32_t PhotonGrid::Around::choose(double& number) const {
  auto share = shares.begin();
  for (; share + 1 != shares.end() && number >= share->share; ++share) { number -= share->share; }
  number = std::min(number / share->share, 1.0 - 0x1p-53);
  return share->source;
}

}  // namespace radiosity
