// SPDX-License-Identifier: MIT
#include "heap.hpp"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include <malloc.h>

namespace {

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
std::atomic<std::uint64_t> count{0}, fail_from{never}, fail_to{never};
std::atomic<std::int64_t> living{0}, bytes{0}, peak{0};

void* allocate(std::size_t size, bool& fails) {
  const std::uint64_t i = ++count;
  fails = i >= fail_from && i < fail_to;
  if (fails) { return nullptr; }
  void* const block = std::malloc(size > 0 ? size : 1);
  fails = block == nullptr;
  if (fails) { return nullptr; }
  ++living;
  const auto more = static_cast<std::int64_t>(::malloc_usable_size(block));
  const std::int64_t now = bytes += more;
  std::int64_t highest = peak;
  while (highest < now && !peak.compare_exchange_weak(highest, now)) {}
  return block;
}

void release(void* block) {
  if (block == nullptr) { return; }
  --living;
  bytes -= static_cast<std::int64_t>(::malloc_usable_size(block));
  std::free(block);
}

}  // namespace

namespace heap {

std::uint64_t allocations() { return count; }
std::int64_t live() { return living; }
std::int64_t live_bytes() { return bytes; }
std::int64_t peak_bytes() { return peak; }
void reset_peak() { peak = bytes.load(); }

Failure::Failure(std::uint64_t nth, Fails fails) {
  const std::uint64_t first = count + nth;
  fail_to = fails == Fails::once ? first + 1 : never;
  fail_from = first;
}
Failure::~Failure() { fail_from = fail_to = never; }
bool Failure::happened() const { return count >= fail_from; }

}  // namespace heap

void* operator new(std::size_t size) {
  bool fails = false;
  void* const block = allocate(size, fails);
  if (fails) { throw std::bad_alloc(); }
  return block;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  bool fails = false;
  return allocate(size, fails);
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { release(block); }
