// SPDX-License-Identifier: MIT
#pragma once

// The methods that a study compares, each with its settings from coarse to fine. A new method is one more entry here.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/radiosity.hpp>

namespace study {

struct Setting {
  std::string text;  // "epsilon 0.01"
  // Timed; the solution brings a comparison, as a rule without a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> run;
  // A solution with the same leaves as `found`, which this setting has given, whose comparison has a dense solution.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Solution& found, const radiosity::Control&)> dense;
  // The same run with nothing left out; empty where the method leaves nothing out.
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> without_shortcuts;
};

struct MethodPlan {
  std::string name;
  std::string summary;
  std::vector<Setting> settings;  // each costs more than the one before
};

struct MethodOptions {
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> memory;  // bytes that a run may take
};

[[nodiscard]] std::vector<MethodPlan> methods(const MethodOptions& options);

}  // namespace study
