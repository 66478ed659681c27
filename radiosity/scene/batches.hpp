// SPDX-License-Identifier: MIT
#pragma once

// Long loops that the caller of a run can cancel: they are done in batches, and the cancel flag is looked at before each of them.

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

// Calls batch(first, last) for consecutive parts of [0, count), each of `size` but the last. Returns false, with the rest undone, once the
// run is cancelled.
template <class Batch>
bool in_batches(const Control& control, std::size_t count, std::size_t size, const Batch& batch) {
  for (std::size_t first = 0; first < count; first += size) {
    if (control.cancelled()) { return false; }
    batch(first, std::min(count, first + size));
  }
  return true;
}

struct Batches {
  std::size_t size;   // between two calls of `done`
  std::size_t block;  // of parallel_for
};

// The same with parallel_for: calls body(i) for each i in [0, count), and done(number of those done so far) after each batch. The flag is
// looked at before each call of body, so that a run which is cancelled ends within one such call of each thread.
template <class Body, class Done>
bool parallel_in_batches(const Control& control, unsigned threads, std::size_t count, Batches batches, const Body& body, const Done& done) {
  std::atomic<bool> complete{true};
  const bool begun = in_batches(control, count, batches.size, [&](std::size_t first, std::size_t last) {
    parallel_for(
        last - first, threads,
        [&](std::size_t k) {
          if (control.cancelled()) {
            complete.store(false, std::memory_order_relaxed);
          } else {
            body(first + k);
          }
        },
        batches.block);
    if (complete) { done(last); }
  });
  return begun && complete;
}
template <class Body>
bool parallel_in_batches(const Control& control, unsigned threads, std::size_t count, Batches batches, const Body& body) {
  return parallel_in_batches(control, threads, count, batches, body, [](std::size_t) {});
}

}  // namespace radiosity
