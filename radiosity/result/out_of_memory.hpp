// SPDX-License-Identifier: MIT
#pragma once

// Memory that runs out as an outcome.

#include <new>
#include <optional>
#include <stdexcept>

#include <radiosity/result/outcome.hpp>

namespace radiosity {

namespace detail {

// Calls `attempt`, which returns an Outcome or the like of it; memory that runs out in it, here or on another thread, is an outcome in a
// program that is compiled with exceptions.
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
  } catch (const std::bad_alloc&) {}  // not even for a sentence
  return outcome;
#else
  return attempt();
#endif
}

}  // namespace detail

}  // namespace radiosity
