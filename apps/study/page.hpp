// SPDX-License-Identifier: MIT
#pragma once

// The study as one page: works from a file, holds all of its pictures, needs no script and no network; made to be read on paper, too.

#include <string>

#include "apps/study/results.hpp"

namespace study {

[[nodiscard]] std::string page(const Study& study);

}  // namespace study
