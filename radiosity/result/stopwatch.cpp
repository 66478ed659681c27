// SPDX-License-Identifier: MIT
#include <radiosity/result/stopwatch.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/result/audit.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE void Stopwatch::lap(std::string name) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  stages_->push_back({std::move(name), std::chrono::duration<double>(wall - wall_).count(),
                      static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC, peak_memory()});
  wall_ = wall;
  cpu_ = cpu;
}

HALFLIGHT_INLINE void add_times(std::vector<StageTime>& total, const std::vector<StageTime>& round) {
  for (const StageTime& stage : round) {
    auto same = std::find_if(total.begin(), total.end(), [&](const StageTime& t) { return t.name == stage.name; });
    if (same == total.end()) { same = total.insert(same, {stage.name, 0.0, 0.0}); }
    same->wall_seconds += stage.wall_seconds;
    same->cpu_seconds += stage.cpu_seconds;
    same->peak_bytes = stage.peak_bytes;
  }
}

HALFLIGHT_INLINE void sum_times(Audit& audit) {
  audit.wall_seconds = 0.0;
  audit.cpu_seconds = 0.0;
  for (const StageTime& stage : audit.stages) {
    if (stage.name == "audit" || stage.name == "compare") { continue; }
    audit.wall_seconds += stage.wall_seconds;
    audit.cpu_seconds += stage.cpu_seconds;
  }
}

}  // namespace detail

}  // namespace radiosity
