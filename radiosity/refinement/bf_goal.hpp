// SPDX-License-Identifier: MIT
#pragma once

// What BF-refinement (bf_refine.hpp) aims at, how long it may take, and what it gives.

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
  std::uint64_t evaluations = 0;  // of links
  std::uint32_t generations = 0;
  double estimate = 0.0;       // relative L2 error, with this part of the variation over leaves,
  double leaf_estimate = 0.0;  // and with all of it
  double unseen = 0.0;         // share of its square that is due to links through which no segment came
  bool interrupted = false;
  std::uint64_t too_large = 0;  // bytes that a finer solution would have needed, when that was more than the budget allows
};

// Seconds that refinement may take, from some beginning.
class Deadline {
 public:
  explicit Deadline(std::optional<double> seconds) : seconds_{seconds} {}

  // How many links can be evaluated in what is left, when `links` were until now; the last solution takes its part.
  [[nodiscard]] std::size_t links_left(std::uint64_t links) const;
  [[nodiscard]] bool limited() const { return seconds_.has_value(); }

 private:
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The estimated relative error, with `leaf_part` of the variation over leaves (leaf_error.hpp), is to be at most `target`, or, with a
// limit, as small as the deadline allows.
struct BfGoal {
  double target = 0.0;
  double leaf_part = 1.0;
  Deadline deadline;
  AnyOracle oracle = BfOracle{};  // about links with large errors
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_goal.cpp>
#endif
