// SPDX-License-Identifier: MIT
#pragma once

// A study as files in a folder:
//
//   index.html                       everything, one page (page.hpp)
//   results.csv results.json         all numbers
//   SCENE_cpu.svg, SCENE_memory.svg, SCENE_links.svg, SCENE_reconstruction.svg
//   SCENE_error_METHOD.svg           false-colour error pictures

#include <optional>
#include <string>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

// What write_pages() writes, without the folder. No two are the same.
[[nodiscard]] std::vector<std::string> page_files(const Study& study);

// Writes them all, the folder too where there is none. A sentence when something could not be written; what was written before stays.
[[nodiscard]] std::optional<std::string> write_pages(const Study& study, const std::string& folder);

}  // namespace study
