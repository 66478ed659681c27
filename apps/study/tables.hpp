// SPDX-License-Identifier: MIT
#pragma once

// The numbers of a study: for spreadsheets and statistics (CSV), for programs (JSON). In both an error below the noise of its reference is
// given as that noise, and marked (outcome.hpp).

#include <string>
#include <string_view>

#include "apps/study/results.hpp"

namespace study {

// A field of CSV (RFC 4180): quoted where it holds a comma, a quote or a line end.
[[nodiscard]] std::string csv_field(std::string_view text);

// One line a run and reconstruction (none, simple, weighted), after one line of names. What was not measured is empty; a run without
// result has its reason in `refused`. `below_noise` names the columns whose value is only an upper bound, apart by spaces.
[[nodiscard]] std::string to_csv(const Study& study);

// The same, nested, and what was derived from it: Pareto fronts and slopes. Its keys are described in examples/scenes/README.md.
[[nodiscard]] std::string to_json(const Study& study);

}  // namespace study
