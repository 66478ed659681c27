// SPDX-License-Identifier: MIT
#pragma once

// Deterministic parallelism: the work is cut into blocks by index, each block writes only its own results, and
// whoever sums them does so in index order. So the bits of a result never depend on the number of threads.

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cstddef>
#include <thread>
#include <vector>

namespace radiosity {

[[nodiscard]] inline unsigned thread_count(unsigned wanted) {
  return wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

// Calls body(i) once for each i in [0, count), in any order, on up to `threads` threads.
// `body` must not touch what another index writes. Blocks are handed out on demand.
template <class Body>
void parallel_for(std::size_t count, unsigned threads, const Body& body, std::size_t block = 64) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (;;) {
      const std::size_t first = next.fetch_add(block, std::memory_order_relaxed);
      if (first >= count) { return; }
      const std::size_t last = std::min(count, first + block);
      for (std::size_t i = first; i < last; ++i) { body(i); }
    }
  };
  const std::size_t blocks = (count + block - 1) / block;
  const std::size_t helpers = std::min<std::size_t>(threads, blocks);
  std::vector<std::jthread> pool;
  for (std::size_t i = 1; i < helpers; ++i) { pool.emplace_back(work); }
  work();
}

// Rounds of work, one after the other: body(round, i) once for each i in [0, counts[round]), in any order within a round. What one call
// writes no other call of the same round may touch.
template <class Body>
void parallel_rounds(const std::vector<std::size_t>& counts, unsigned threads, const Body& body) {
  std::size_t most = 1;
  for (const std::size_t count : counts) { most = std::max(most, count); }
  const auto workers = static_cast<std::ptrdiff_t>(std::min<std::size_t>(threads, most));
  std::vector<std::atomic<std::size_t>> next(counts.size());
  std::barrier<> barrier{workers};
  const auto work = [&] {
    for (std::size_t round = 0; round < counts.size(); ++round) {
      for (;;) {
        const std::size_t i = next[round].fetch_add(1, std::memory_order_relaxed);
        if (i >= counts[round]) { break; }
        body(round, i);
      }
      if (workers > 1) { barrier.arrive_and_wait(); }
    }
  };
  std::vector<std::jthread> pool;
  for (std::ptrdiff_t i = 1; i < workers; ++i) { pool.emplace_back(work); }
  work();
}

}  // namespace radiosity
