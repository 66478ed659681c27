// SPDX-License-Identifier: MIT
#pragma once

// A recording as sentences: why a pair was linked or split, what a link carries, what BF-refinement splits: one sentence each, the same on
// the page and in the terminal. And the whole as text, and as a page that replays it.

#include <string>

#include "apps/explain/recording.hpp"

namespace apps::explain {

[[nodiscard]] std::string number(double x);  // three digits

[[nodiscard]] std::string sentence_of(const Recording& recording, const Pair& pair);
[[nodiscard]] std::string sentence_of(const Recording& recording, const LinkRecord& link);
[[nodiscard]] std::string sentence_of(const Recording& recording, const BfChoice& choice);

// `halflight explain --text`.
[[nodiscard]] std::string story(const Recording& recording);

// The page (page.html, page.css, page.js).
[[nodiscard]] std::string page(const Recording& recording);

}  // namespace apps::explain
