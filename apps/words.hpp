// SPDX-License-Identifier: MIT
#pragma once

// Compares words without regard to case, and finds the known word that was probably meant by an unknown one.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

// Are both words equal, whatever the case of the first? `small` must be in lower case.
[[nodiscard]] bool same_letters(std::string_view word, std::string_view small);

// The known word with the fewest edits (Damerau 1964, Levenshtein 1966), if these are at most a third of its letters; else
// empty. Of equal ones the first in the list is taken. Words of more than 40 letters have no match.
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

// "; did you mean 'x'?", or empty.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> known);
[[nodiscard]] inline std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  return suggestion(word, std::vector<std::string_view>(known.begin(), known.end()));
}

// "a, b or c"; long lists end with "...".
[[nodiscard]] std::string list_of(std::span<const std::string_view> words);

}  // namespace apps
