// SPDX-License-Identifier: MIT
#pragma once

// The methods that a study compares, each with its settings from coarse to fine. A new method is one more entry here.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <radiosity/radiosity.hpp>

namespace study {

struct Setting {
  std::string text;  // "epsilon 0.01"
  std::function<radiosity::Outcome(const radiosity::Scene&, const radiosity::Control&)> run;
};

struct MethodPlan {
  std::string name;
  std::string summary;
  std::vector<Setting> settings;  // each costs more than the one before
};

struct MethodOptions {
  std::uint32_t dense_leaves = 1000;  // the parts of an error are told apart on at most so many leaves
  unsigned threads = 0;
  std::uint64_t seed = 1;
};

[[nodiscard]] std::vector<MethodPlan> methods(const MethodOptions& options);

}  // namespace study
