// SPDX-License-Identifier: MIT
#pragma once

// The words that a statement of a script may begin with, and the one that was meant when another stands there.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace apps::euler {

// Operators by our names and by those of textbooks, and the other statements.
[[nodiscard]] std::vector<std::string> statement_words();

// "; did you mean 'split_face'?" of a line whose first word, after a name and =, is not known but near to one that is; else nothing.
[[nodiscard]] std::string meant(std::string_view line, const std::vector<std::string>& known);

// The same of a line of a script, counted from 1.
[[nodiscard]] std::string meant_in(std::string_view script, std::uint32_t line);

}  // namespace apps::euler
