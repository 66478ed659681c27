// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "apps/commands/command.hpp"
#include "apps/commands/render_outputs.hpp"

namespace apps {

// What each option of `halflight render` is, and where its value goes.
[[nodiscard]] std::vector<Argument> render_arguments(RenderOptions& options);

}  // namespace apps
