// SPDX-License-Identifier: MIT
#pragma once

// How much memory a run takes: what the process held at most, as the system tells it, and what a run will hold, predicted from the numbers
// of its nodes, links and pairs before they are made.
//
// The prediction depends on the scene and the options alone, so a limit gives the same result on any machine. It counts the tables of
// refinement, evaluation, solution and reconstruction. What it cannot count before it is there is the scene itself: its objects,
// their first BReps, and what is read to make them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory_resource>
#include <optional>
#include <string>

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#define HALFLIGHT_HAS_RUSAGE
#endif

namespace radiosity {

// Most memory that the process has held at once until now, in bytes; nothing where the system does not tell. On Linux a program that was
// started by another counts the peak of that one before it became this (getrusage(2)).
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

// "3.1 GB"
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

// The memory that a run of the hierarchical solver may take on top of what the process holds when it begins.
struct MemoryBudget {
  std::uint64_t allowed = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t fixed = 0;    // of the run, whatever it refines: objects, first BReps, tables of clusters, points of the audit
  bool a_posteriori = false;  // BF-refinement keeps the error of each link (MeasuredLink, evaluate.hpp)
  // BF-refinement ends with the solution of this generation: memory ran out in the next one.
  std::uint32_t last_generation = std::numeric_limits<std::uint32_t>::max();
  std::pmr::memory_resource* arrays = nullptr;  // where big arrays lie (big_array.hpp)
  // Where BF-refinement writes how many generations have a solution, and F-refinement that it has begun: larger thresholds may need less.
  std::uint32_t* solved = nullptr;

  // What of a run counts, at some moment.
  struct Counts {
    std::uint64_t nodes = 0;
    std::uint64_t links = 0;
    std::uint64_t pairs = 0;      // open, of refinement
    std::uint64_t occluders = 0;  // bytes of their lists
    std::uint64_t rays = 0;       // stored
  };

  // Bytes at the peak. Of each node: itself (112), its patch (1400), its faces, edges and vertices (350), what its exposure (70), the
  // solution (150) and the mesh (300) add. Of each link: itself (24), and the pair from which it is made (12), whose table may be half
  // empty (24); of BF-refinement its record (84), which is copied as the table grows, and its error: 178 in all. Of each pair: itself, the
  // decision, the rays; and a batch of occluder lists at full length. Of each stored ray: itself (32), its part of a link (40), its place
  // in their order (4) and at most one link, in a table that may be half empty (72). Held against what runs take in
  // tests/memory/budget_test.cpp.
  [[nodiscard]] std::uint64_t peak(const Counts& counts) const;
  [[nodiscard]] bool allows(const Counts& counts) const { return peak(counts) <= allowed; }
  [[nodiscard]] bool limited() const { return allowed != std::numeric_limits<std::uint64_t>::max(); }
};

// Why a run ended before it would have held so many bytes.
[[nodiscard]] inline std::string too_much_memory(std::uint64_t needed, std::uint64_t allowed, const char* what_to_do) {
  return "the run would need at least " + memory_text(needed) + " of memory and may take " + memory_text(allowed) + "; " + what_to_do;
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/support/memory.cpp>
#endif
