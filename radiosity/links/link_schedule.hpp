// SPDX-License-Identifier: MIT
#pragma once

// The order in which links carry light, so that several threads can work and the bits of the result do not depend on their number.
//
// The nodes are divided into tiles with about equally many link ends. The links between two tiles form a block. Blocks are assigned to
// rounds, as in a tournament: within a round no tile occurs in two blocks, so no two threads write to the same node, and the
// contributions to a node are summed in the order of the rounds and, within a block, of the links. Blocks are assigned largest first, so
// that those of one round have about the same size. Few links form a single block.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <radiosity/hierarchy/links.hpp>

namespace radiosity {

class LinkSchedule {
 public:
  struct Block {
    std::size_t begin = 0, end = 0;  // range of its links
  };

  // Arranges the links by block, unless they are already arranged.
  LinkSchedule(std::size_t nodes, std::span<Link> links);

  // Sorts an array or span of records by block, keeping the order within a block. Records are Links, or types for which link_of(record)
  // returns one.
  template <class Array>
  static void arrange(std::size_t nodes, Array& links) {
    using Record = typename Array::value_type;
    if (links.size() < few) { return; }
    const std::vector<std::uint8_t> tile = tiles_of(nodes, links);
    const auto block = [&](const Record& record) { return block_of(tile, link_of(record)); };
    if (std::is_sorted(links.begin(), links.end(), [&](const Record& a, const Record& b) { return block(a) < block(b); })) { return; }
    std::vector<std::size_t> next = first_of_blocks(tile, links);
    std::vector<std::uint32_t> from(links.size());  // by place: index of the link that moves there
    for (std::uint32_t i = 0; i < links.size(); ++i) { from[next[block(links[i])]++] = i; }
    for (std::uint32_t start = 0; start < links.size(); ++start) {  // permute in place, cycle by cycle
      if (from[start] == start) { continue; }
      const Record first = links[start];
      std::uint32_t k = start;
      while (from[k] != start) {
        links[k] = links[from[k]];
        k = std::exchange(from[k], k);
      }
      links[k] = first;
      from[k] = k;
    }
  }

  [[nodiscard]] const std::vector<std::vector<Block>>& rounds() const { return rounds_; }

 private:
  static constexpr std::size_t tiles = 16, few = 1 << 14;

  // A new tile begins where the running count of link ends passes a multiple of the mean.
  template <class Array>
  static std::vector<std::uint8_t> tiles_of(std::size_t nodes, const Array& links) {
    std::vector<std::uint32_t> ends(nodes, 0);
    for (const auto& record : links) {
      ++ends[link_of(record).p];
      ++ends[link_of(record).q];
    }
    std::vector<std::uint8_t> tile(nodes);
    std::size_t before = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      tile[i] = static_cast<std::uint8_t>(std::min(tiles - 1, before * tiles / (2 * links.size())));
      before += ends[i];
    }
    return tile;
  }
  static std::size_t block_of(const std::vector<std::uint8_t>& tile, const Link& link) {
    const std::size_t a = tile[link.p], b = tile[link.q];
    return std::max(a, b) * tiles + std::min(a, b);
  }
  // The index of the first link of each block, once the links are arranged.
  template <class Array>
  static std::vector<std::size_t> first_of_blocks(const std::vector<std::uint8_t>& tile, const Array& links) {
    std::vector<std::size_t> first(tiles * tiles + 1, 0);
    for (const auto& record : links) { ++first[block_of(tile, link_of(record)) + 1]; }
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
  }

  std::vector<std::vector<Block>> rounds_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/links/link_schedule.cpp>
#endif
