// SPDX-License-Identifier: MIT
#pragma once

// Deterministic parallelism: the work is divided into blocks by index, each block writes only its own results, and sums are
// made in index order. So the bits of a result never depend on the number of threads.
//
// If the system cannot start a thread, the others do its part. An exception of a body (out of memory) ends the loop early and is rethrown
// on the calling thread once all threads have ended; if there are several, one of them. In a program compiled without exceptions, both
// cases end the program.

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cstddef>
#include <thread>
#include <vector>

#if defined(__cpp_exceptions)
#include <exception>
#include <new>
#include <system_error>
#endif

namespace radiosity {

[[nodiscard]] inline unsigned thread_count(unsigned wanted) {
  return wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

namespace detail {

// Passes the first exception of a body on to the caller of the loop.
class Thrown {
 public:
  // Calls body(); returns false if it threw.
  template <class Body>
  [[nodiscard]] bool call(const Body& body) {
#if defined(__cpp_exceptions)
    try {
      body();
      return true;
    } catch (...) {
      if (!any_.exchange(true)) { first_ = std::current_exception(); }
      return false;
    }
#else
    body();
    return true;
#endif
  }
  [[nodiscard]] bool any() const { return any_.load(std::memory_order_relaxed); }

  // To be called once all threads have ended.
  void rethrow() const {
#if defined(__cpp_exceptions)
    if (first_) { std::rethrow_exception(first_); }
#endif
  }

 private:
  std::atomic<bool> any_{false};
#if defined(__cpp_exceptions)
  std::exception_ptr first_;
#endif
};

// Starts up to `count` threads that run work(); returns how many could be started. `work` must not throw.
template <class Work>
std::size_t start_threads(std::vector<std::jthread>& pool, std::size_t count, const Work& work) {
#if defined(__cpp_exceptions)
  try {
    pool.reserve(count);
    while (pool.size() < count) {
      pool.emplace_back([&work] { work(); });
    }
  } catch (const std::system_error&) {  // no more threads, or no memory for a stack
  } catch (const std::bad_alloc&) {}
#else
  pool.reserve(count);
  while (pool.size() < count) {
    pool.emplace_back([&work] { work(); });
  }
#endif
  return pool.size();
}

}  // namespace detail

// Calls body(i) once for each i in [0, count), in any order, on up to `threads` threads.
// `body` must not touch what another index writes. Blocks are handed out on demand.
template <class Body>
void parallel_for(std::size_t count, unsigned threads, const Body& body, std::size_t block = 64) {
  std::atomic<std::size_t> next{0};
  detail::Thrown thrown;
  const auto work = [&] {
    const bool done = thrown.call([&] {
      for (;;) {
        const std::size_t first = next.fetch_add(block, std::memory_order_relaxed);
        if (first >= count) { return; }
        const std::size_t last = std::min(count, first + block);
        for (std::size_t i = first; i < last; ++i) { body(i); }
      }
    });
    if (!done) { next.store(count, std::memory_order_relaxed); }  // leave no blocks for the other threads
  };
  const std::size_t blocks = (count + block - 1) / block;
  const std::size_t workers = std::min<std::size_t>(threads, blocks);
  {
    std::vector<std::jthread> pool;
    if (workers > 1) { (void)detail::start_threads(pool, workers - 1, work); }
    work();
  }
  thrown.rethrow();
}

// Rounds of work, one after the other: calls body(round, i) once for each i in [0, counts[round]), in any order within a round. No two
// calls of a round may write the same data.
template <class Body>
void parallel_rounds(const std::vector<std::size_t>& counts, unsigned threads, const Body& body) {
  std::size_t most = 1;
  for (const std::size_t count : counts) { most = std::max(most, count); }
  const std::size_t workers = std::clamp<std::size_t>(threads, 1, most);
  std::vector<std::atomic<std::size_t>> next(counts.size());
  std::barrier<> barrier{static_cast<std::ptrdiff_t>(workers)};
  detail::Thrown thrown;
  const auto work = [&] {
    for (std::size_t round = 0; round < counts.size() && !thrown.any(); ++round) {
      (void)thrown.call([&] {
        while (!thrown.any()) {
          const std::size_t i = next[round].fetch_add(1, std::memory_order_relaxed);
          if (i >= counts[round]) { return; }
          body(round, i);
        }
      });
      if (workers > 1) { barrier.arrive_and_wait(); }
    }
    if (workers > 1) { barrier.arrive_and_drop(); }  // after an exception some threads leave early, and the others must not wait for them
  };
  {
    std::vector<std::jthread> pool;
    const std::size_t started = workers > 1 ? detail::start_threads(pool, workers - 1, work) : 0;
    for (std::size_t missing = started + 1; missing < workers; ++missing) { barrier.arrive_and_drop(); }
    work();
  }
  thrown.rethrow();
}

}  // namespace radiosity
