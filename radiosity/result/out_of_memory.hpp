// SPDX-License-Identifier: MIT
#pragma once

// Returns running out of memory as an outcome instead of an exception.

#include <new>
#include <optional>
#include <stdexcept>

#include <radiosity/result/outcome.hpp>

namespace radiosity {

namespace detail {

// Calls `attempt`, which returns an Outcome or a similar struct. If memory runs out in it, on this or another thread, returns
// Failure::Kind::out_of_memory; only in a program compiled with exceptions.
template <class Attempt>
[[nodiscard]] auto unless_out_of_memory(const Attempt& attempt) -> decltype(attempt()) {
#if defined(__cpp_exceptions)
  try {
    return attempt();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {}  // a table longer than the address space
  decltype(attempt()) outcome{std::nullopt, {Failure::Kind::out_of_memory, {}}};
  try {
    outcome.failure.sentences.emplace_back(
        "the system has no more memory for this run; a larger epsilon, min_area, target or error needs less");
  } catch (const std::bad_alloc&) {}  // no memory even for the sentence
  return outcome;
#else
  return attempt();
#endif
}

}  // namespace detail

}  // namespace radiosity
