// SPDX-License-Identifier: MIT
#pragma once

// Memory of a run: the peak of the process, as reported by the system, and a prediction from the numbers of nodes, links and pairs before
// they are made.
//
// The prediction depends only on scene and options, so a limit gives the same result on any machine. It includes the tables of
// refinement, evaluation, solution and reconstruction, but not the scene itself: its objects, their first BReps, and the data read to
// make them.

#include <cstdint>
#include <limits>
#include <memory_resource>
#include <optional>
#include <string>

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#define HALFLIGHT_HAS_RUSAGE
#endif

namespace radiosity {

// Largest memory of the process so far, in bytes; nothing if the system does not tell. On Linux a process started by another one includes
// the peak of that process before exec (getrusage(2)).
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

// "3.1 GB"
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

// The memory that a hierarchical run may take, in addition to what the process holds at its beginning.
struct MemoryBudget {
  std::uint64_t allowed = std::numeric_limits<std::uint64_t>::max();
  bool by_default = false;    // nobody has set this limit (Options::allowed_memory)
  std::uint64_t fixed = 0;    // independent of refinement: objects, first BReps, tables of clusters, points of the audit
  bool a_posteriori = false;  // BF-refinement stores the error of each link (MeasuredLink, evaluate.hpp)
  // BF-refinement ends with the solution of this generation, because memory ran out in the next one.
  std::uint32_t last_generation = std::numeric_limits<std::uint32_t>::max();
  std::pmr::memory_resource* arrays = nullptr;  // memory of big arrays (big_array.hpp)
  // If set, BF-refinement writes the number of generations with a solution here, and F-refinement 1 once it has begun: larger thresholds
  // may then need less.
  std::uint32_t* solved = nullptr;

  // The sizes of a run at some moment.
  struct Counts {
    std::uint64_t nodes = 0;
    std::uint64_t links = 0;
    std::uint64_t pairs = 0;      // open pairs of refinement
    std::uint64_t occluders = 0;  // bytes of their lists
    std::uint64_t rays = 0;       // stored rays
  };

  // Bytes at the peak. Per node: itself (112), its patch (1400), faces, edges and vertices (350), exposure (70), solution (150), mesh
  // (300). Per link: itself (24), and the pair from which it is made (12), whose table may be half empty (24); in BF-refinement its
  // record (84), which is copied when the table grows, and its error: 178 in all. Per pair: itself, the decision, the rays; and a batch
  // of occluder lists at full length. Per stored ray: itself (32), its part of a link (40), its place in their order (4), and at most one
  // link, in a table that may be half empty (72). Compared with actual runs in tests/memory/budget_test.cpp.
  [[nodiscard]] std::uint64_t peak(const Counts& counts) const;
  [[nodiscard]] bool allows(const Counts& counts) const { return peak(counts) <= allowed; }
  [[nodiscard]] bool limited() const { return allowed != std::numeric_limits<std::uint64_t>::max(); }
};

// The sentence of a run that ended before it would have held so many bytes.
[[nodiscard]] inline std::string too_much_memory(std::uint64_t needed, const MemoryBudget& budget, const char* what_to_do) {
  return "the run would need at least " + memory_text(needed) + " of memory and may take " + memory_text(budget.allowed) + "; " +
         what_to_do + (budget.by_default ? "; no limit was set, so that of runs towards an accuracy holds" : "");
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/support/memory.cpp>
#endif
