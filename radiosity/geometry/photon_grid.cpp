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

#include <raycast/inline.hpp>

#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::uint32_t photon_grids = 4;          // each with cells twice as wide as those before
inline constexpr double finest_photon_cell = 1.0 / 64.0;  // of the diameter of the scene
inline constexpr std::size_t least_photons = 16;          // in a cell that is asked

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
    for (std::size_t i = first; i < last; ++i) {
      if (i == first || entries[i].second != entries[i - 1].second) { shares_.push_back({entries[i].second, 0.0}); }
      shares_.back().share += 1.0 / static_cast<double>(last - first);
    }
    cells_[cell] = {begin, shares_.size()};
  }
}

HALFLIGHT_INLINE std::span<const PhotonGrid::Share> PhotonGrid::around(const glm::dvec3& position, const glm::dvec3& normal) const {
  for (std::uint32_t grid = 0; grid < detail::photon_grids && !cells_.empty(); ++grid) {
    const auto found = cells_.find(detail::photon_cell(grid, std::ldexp(width_, static_cast<int>(grid)), position, normal));
    if (found != cells_.end()) { return std::span{shares_}.subspan(found->second.first, found->second.last - found->second.first); }
  }
  return {};
}

HALFLIGHT_INLINE double PhotonGrid::share_of(std::span<const Share> shares, std::uint32_t source) {
  const auto at = std::lower_bound(shares.begin(), shares.end(), source, [](const Share& s, std::uint32_t of) { return s.source < of; });
  return at != shares.end() && at->source == source ? at->share : 0.0;
}

}  // namespace radiosity
