// SPDX-License-Identifier: MIT
// The caller's memory for big arrays: what grows with a run lies there, all of it comes back, and the result is the same to the bit.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory_resource>
#include <mutex>
#include <new>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/stress/scenes.hpp"

#include "catch.hpp"
#include "heap.hpp"

namespace {

// Counts, and has no more than `limit`. Its blocks do not come from the counted heap.
class CountingMemory final : public std::pmr::memory_resource {
 public:
  std::size_t live = 0, peak = 0, limit = SIZE_MAX;

 private:
  void* do_allocate(std::size_t bytes, std::size_t) override {  // malloc's alignment is enough for what is in these arrays
    const std::lock_guard lock(mutex_);
    if (live + bytes > limit) { throw std::bad_alloc(); }
    live += bytes;
    peak = std::max(peak, live);
    return std::malloc(bytes);
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t) override {
    const std::lock_guard lock(mutex_);
    live -= bytes;
    std::free(block);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::mutex mutex_;
};

struct Way {
  const char* name;
  radiosity::Refinement refinement;
  radiosity::Indirect indirect;
};
constexpr Way ways[] = {{"links", radiosity::Refinement::a_priori, radiosity::Indirect::links},
                        {"stored rays", radiosity::Refinement::a_priori, radiosity::Indirect::rays},
                        {"BF", radiosity::Refinement::a_posteriori, radiosity::Indirect::links}};

radiosity::Options options_of(const Way& way, double epsilon) {
  return {.refinement = way.refinement,
          .target = epsilon,
          .epsilon = epsilon,
          .min_area = 0.1 * epsilon,
          .indirect = way.indirect,
          .audit_points = 0,
          .threads = 2};
}

}  // namespace

TEST_CASE("memory of the caller: big arrays lie there, the result is the same to the bit, and all comes back") {
  const radiosity::Scene scene = apps::stress::room_with_box();
  for (const Way& way : ways) {
    INFO(way.name);
    double whole_before = 0.0, there_before = 0.0;
    for (const double epsilon : {0.08, 0.02}) {
      radiosity::Options options = options_of(way, epsilon);
      const std::int64_t before = heap::live_bytes();
      heap::reset_peak();
      const radiosity::Outcome on_heap = radiosity::solve(scene, options);
      const auto whole = static_cast<double>(heap::peak_bytes() - before);
      CountingMemory memory;
      options.arrays = &memory;
      {
        const radiosity::Outcome outcome = radiosity::solve(scene, options);
        REQUIRE(on_heap.solution);
        REQUIRE(outcome.solution);
        CHECK(outcome.solution->radiosity == on_heap.solution->radiosity);
        CHECK(memory.live >=
              outcome.solution->links.size() * sizeof(radiosity::Link) + outcome.solution->hierarchy.size() * sizeof(radiosity::Node));
        const radiosity::Links copy = outcome.solution->links;
        CHECK(copy.get_allocator().memory() == nullptr);
      }
      CHECK(memory.live == 0);
      // Of the 2400 bytes of a node (MemoryBudget) some 1400 are its record, patch and quadrature points; links, pairs and rays lie there
      // wholly.
      const auto there = static_cast<double>(memory.peak);
      if (whole_before > 0.0) { CHECK(there - there_before > 0.5 * (whole - whole_before)); }
      whole_before = whole;
      there_before = there;
    }
  }
}

TEST_CASE("memory of the caller that runs out is an outcome") {
  const radiosity::Scene scene = apps::stress::room_with_box();
  for (const Way& way : ways) {
    INFO(way.name);
    CountingMemory memory;
    radiosity::Options options = options_of(way, 0.04);
    options.arrays = &memory;
    REQUIRE(radiosity::solve(scene, options).solution);
    for (std::size_t limit = memory.peak / 16; limit < memory.peak; limit += memory.peak / 8) {
      memory.limit = limit;
      const radiosity::Outcome outcome = radiosity::solve(scene, options);
      CHECK(
          (outcome.solution ? !outcome.solution->audit.shortage.empty() : outcome.failure.kind == radiosity::Failure::Kind::out_of_memory));
    }
    CHECK(memory.live == 0);
  }
}
