// SPDX-License-Identifier: MIT
#pragma once

// The stepper: one page that shows a script step by step; no network, no library, works from a file.
//
// The page holds all drawings and all records as data; its own script shows one step, marks the fields that the step changed, and
// moves what both pictures have. `#step=12` in the address opens that step.

#include <string>

#include "apps/euler/story.hpp"

namespace apps::euler {

[[nodiscard]] std::string page(const Story& story);

}  // namespace apps::euler
