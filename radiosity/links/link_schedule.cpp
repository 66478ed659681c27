// SPDX-License-Identifier: MIT
#include <radiosity/links/link_schedule.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/links.hpp>

namespace radiosity {

HALFLIGHT_INLINE LinkSchedule::LinkSchedule(std::size_t nodes, std::span<Link> links) {
  if (links.size() < few) {
    rounds_.push_back({{0, links.size()}});
    return;
  }
  arrange(nodes, links);
  const std::vector<std::size_t> first = first_of_blocks(tiles_of(nodes, links), links);
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < tiles * tiles; ++b) {
    if (first[b] < first[b + 1]) { blocks.push_back(b); }
  }
  const auto size = [&](std::size_t b) { return first[b + 1] - first[b]; };
  std::stable_sort(blocks.begin(), blocks.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  std::vector<std::uint64_t> busy;  // tiles used by each round, as bits
  for (const std::size_t b : blocks) {
    const std::uint64_t both = std::uint64_t{1} << b / tiles | std::uint64_t{1} << b % tiles;
    std::size_t round = 0;
    while (round < busy.size() && (busy[round] & both) != 0) { ++round; }
    if (round == busy.size()) {
      busy.push_back(0);
      rounds_.emplace_back();
    }
    busy[round] |= both;
    rounds_[round].push_back({first[b], first[b + 1]});
  }
}

}  // namespace radiosity
