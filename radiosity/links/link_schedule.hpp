// SPDX-License-Identifier: MIT
#pragma once

// In which order the links carry light, so that several threads can work and the bits of the result do not depend on how many.
//
// The nodes are cut into tiles with about equally many ends of links. The links between two tiles are a block. Blocks go in rounds, as in a
// tournament: in one round no tile is in two blocks, so nobody writes where another does, and what arrives at a node is summed in
// the order of the rounds and, within a block, of the links. Blocks are given to rounds largest first, so that those
// of one round are about equally large. Few links are one block.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <radiosity/hierarchy/links.hpp>

namespace radiosity {

class LinkSchedule {
 public:
  struct Block {
    std::size_t begin = 0, end = 0;  // of the links
  };

  // Arranges the links, unless they are arranged.
  LinkSchedule(std::size_t nodes, Links& links);

  // Moves the links of a block together, in their order, and what belongs to each link with it.
  template <class... Others>
  static void arrange(std::size_t nodes, Links& links, std::vector<Others>&... others) {
    if (links.size() < few) { return; }
    const std::vector<std::uint8_t> tile = tiles_of(nodes, links);
    const auto before = [&](const Link& a, const Link& b) { return block_of(tile, a) < block_of(tile, b); };
    if (std::is_sorted(links.begin(), links.end(), before)) { return; }
    std::vector<std::size_t> next = first_of_blocks(tile, links);
    std::vector<std::uint32_t> from(links.size());  // of each place: which of the links comes there
    for (std::uint32_t i = 0; i < links.size(); ++i) { from[next[block_of(tile, links[i])]++] = i; }
    (gather(from, others), ...);
    for (std::uint32_t start = 0; start < links.size(); ++start) {  // in place, cycle by cycle
      if (from[start] == start) { continue; }
      const Link first = links[start];
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

  // Bounds between tiles lie where the running count of link ends passes a multiple of the mean.
  static std::vector<std::uint8_t> tiles_of(std::size_t nodes, const Links& links);
  static std::size_t block_of(const std::vector<std::uint8_t>& tile, const Link& link);
  static std::vector<std::size_t> first_of_blocks(const std::vector<std::uint8_t>& tile, const Links& links);
  template <class T>
  static void gather(const std::vector<std::uint32_t>& from, std::vector<T>& values) {
    std::vector<T> gathered;
    gathered.reserve(values.size());
    for (const std::uint32_t i : from) { gathered.push_back(values[i]); }
    values = std::move(gathered);
  }

  std::vector<std::vector<Block>> rounds_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/links/link_schedule.cpp>
#endif
