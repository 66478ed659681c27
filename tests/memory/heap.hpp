// SPDX-License-Identifier: MIT
#pragma once

// The heap of this test program counts, and fails when it is told to.

#include <cstdint>

namespace heap {

// Allocations by operator new since the program began, on all threads.
[[nodiscard]] std::uint64_t allocations();
// Of these, how many have not been freed.
[[nodiscard]] std::int64_t live();
// Bytes that they hold, and the most they have held since the last reset.
[[nodiscard]] std::int64_t live_bytes();
[[nodiscard]] std::int64_t peak_bytes();
void reset_peak();

enum class Fails { once, from_then_on };

// While it lives the n-th allocation from now, on whatever thread, throws bad_alloc, or that and all that follow.
class Failure {
 public:
  Failure(std::uint64_t nth, Fails fails);
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;
  ~Failure();
  [[nodiscard]] bool happened() const;
};

}  // namespace heap
