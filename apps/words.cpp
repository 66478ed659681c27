// SPDX-License-Identifier: MIT
#include "apps/words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace apps {
namespace {

constexpr std::size_t longest = 40;

// Optimal string alignment distance: insert, delete, replace, swap two neighbours. Both words have at most `longest` letters.
std::size_t distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest + 1>;
  Row before{};
  Row last{};
  Row row{};
  for (std::size_t j = 0; j <= b.size(); ++j) { row[j] = j; }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) { row[j] = std::min(row[j], before[j - 2] + 1); }
    }
  }
  return row[b.size()];
}

}  // namespace

bool same_letters(std::string_view word, std::string_view small) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::equal(word.begin(), word.end(), small.begin(), small.end(), same);
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
  std::string_view best;
  if (word.size() > longest) { return best; }
  std::size_t best_distance = longest + 1;
  for (const std::string_view candidate : known) {
    if (candidate.size() > longest) { continue; }
    const std::size_t edits = distance(word, candidate);
    if (edits < best_distance && edits < candidate.size() && 3 * edits <= std::max<std::size_t>(3, candidate.size())) {
      best = candidate;
      best_distance = edits;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view best = nearest(word, known);
  return best.empty() ? std::string() : "; did you mean '" + std::string(best) + "'?";
}

std::string list_of(std::span<const std::string_view> words) {
  constexpr std::size_t most = 16;
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) {
    if (i > 0) { text += i + 1 == words.size() ? " or " : ", "; }
    text += words[i];
  }
  return words.size() > most ? text + ", ..." : text;
}

}  // namespace apps
