// SPDX-License-Identifier: MIT
#pragma once

// A study as files in a folder:
//
//   index.html                       everything, one page (page.hpp)
//   results.csv results.json table.md
//   SCENE_cpu.svg .png, SCENE_memory.*, SCENE_links.*, SCENE_reconstruction.*
//   SCENE_error_METHOD.png           false-colour error pictures

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
