// SPDX-License-Identifier: MIT
#pragma once

// A recording as one page that replays it (page.html, page.css, page.js).

#include <string>

#include "apps/explain/recording.hpp"

namespace apps::explain {

[[nodiscard]] std::string page(const Recording& recording);

}  // namespace apps::explain
