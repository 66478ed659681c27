// SPDX-License-Identifier: MIT
#pragma once

// Measures the times of the stages of a run.

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include <radiosity/result/audit.hpp>

namespace radiosity {

namespace detail {

// Measures the wall and CPU time of stages that follow one another, and the memory at their ends.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& stages) : stages_{&stages} {}

  // Ends the stage that began with the last call (or the construction).
  void lap(std::string name);

 private:
  std::vector<StageTime>* stages_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// Adds the times of a round to the totals, stage by stage.
void add_times(std::vector<StageTime>& total, const std::vector<StageTime>& round);

// Sets the total times, which exclude the audit and comparisons.
void sum_times(Audit& audit);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/stopwatch.cpp>
#endif
