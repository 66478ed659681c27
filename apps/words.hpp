// SPDX-License-Identifier: MIT
#pragma once

// Whether two words are the same, and which known word was probably meant by one that is not known.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

// Is it this word, whatever the case of its letters? `small` is in lower case.
[[nodiscard]] bool same_letters(std::string_view word, std::string_view small);

// The known word that is fewest edits away (Damerau 1964, Levenshtein 1966), when those are at most a third of its
// letters; else empty. Ties go to the word that is listed first. Words beyond 40 letters have no neighbour.
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

// "; did you mean 'x'?" or nothing.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> known);
[[nodiscard]] inline std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  return suggestion(word, std::vector<std::string_view>(known.begin(), known.end()));
}

// "a, b or c"; long lists end with "...".
[[nodiscard]] std::string list_of(std::span<const std::string_view> words);

}  // namespace apps
