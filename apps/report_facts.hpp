// SPDX-License-Identifier: MIT
#pragma once

// All that a report says, as facts in the order of its JSON; the text (report.cpp) names them in its sentences.

#include "apps/facts.hpp"
#include "apps/report.hpp"

namespace apps {

[[nodiscard]] Facts facts_of(const Report& report);

}  // namespace apps
