// SPDX-License-Identifier: MIT
#pragma once

// Goal, time limit and result of BF-refinement (bf_refine.hpp).

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/bf_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/refine_result.hpp>

namespace radiosity {

struct BfResult {
  Links links;
  RefineResult refined;
  EvaluateResult evaluated;
  std::uint64_t evaluations = 0;  // number of link evaluations
  std::uint32_t generations = 0;
  double estimate = 0.0;       // estimated relative L2 error, with leaf_part of the variation over leaves
  double leaf_estimate = 0.0;  // the same with all of that variation
  double unseen = 0.0;         // share of the squared estimate caused by links whose segments were all blocked
  bool interrupted = false;
  std::uint64_t too_large = 0;  // bytes that a finer solution would have needed, if that exceeded the budget
};

// A time limit in seconds, counted from construction.
class Deadline {
 public:
  explicit Deadline(std::optional<double> seconds) : seconds_{seconds} {}

  // How many links can be evaluated in the remaining time, given that `links` were evaluated so far; keeps time for the last solution.
  [[nodiscard]] std::size_t links_left(std::uint64_t links) const;
  [[nodiscard]] bool limited() const { return seconds_.has_value(); }

 private:
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The estimated relative error, with the share `leaf_part` of the variation over leaves (leaf_error.hpp), must be at most `target`; with
// a time limit it is made as small as the deadline allows.
struct BfGoal {
  double target = 0.0;
  double leaf_part = 1.0;
  Deadline deadline;
  AnyOracle oracle = BfOracle{};  // asked about links with large errors
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_goal.cpp>
#endif
