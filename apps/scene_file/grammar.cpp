// SPDX-License-Identifier: MIT
#include "apps/scene_file/grammar.hpp"

#include <algorithm>

#include "apps/text.hpp"

namespace apps::scene_file {
namespace {

using WordList = std::vector<std::string_view>;

WordList words_of(const ObjectKind& kind) {
  WordList words;
  if (!is_csg(kind)) {
    for (const Clause& clause : kind.clauses) { words.push_back(clause.word); }
    words.insert(words.end(), {"material", "sheet", "move", "rotate", "scale"});
    if (kind.solid) { words.push_back("inside"); }
    if (kind.word == "mesh") { words.insert(words.end(), {"file", "two-sided"}); }
    return words;
  }
  words = {"material", "move", "rotate", "scale", "inside"};
  const auto operands = [&](bool solid) {
    for (const ObjectKind& operand : object_kinds()) {
      if (operand.solid == solid) { words.push_back(operand.word); }
    }
  };
  operands(true);
  words.push_back("use");
  operands(false);  // accepted here, so that the error message can say what is wrong with them
  return words;
}

}  // namespace

const ObjectKind* kind_of(std::string_view word) {
  const std::span<const ObjectKind> kinds = object_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const ObjectKind& kind) { return kind.word == word; });
  return found == kinds.end() ? nullptr : &*found;
}

Words statements() {
  static const WordList words = [] {
    WordList result = {"material", "camera"};
    for (const ObjectKind& kind : object_kinds()) { result.push_back(kind.word); }
    result.insert(result.end(), {"define", "use"});
    return result;
  }();
  return words;
}

Words clause_words(const ObjectKind& kind) {
  static const std::vector<WordList> rows = [] {
    std::vector<WordList> result;
    for (const ObjectKind& each : object_kinds()) { result.push_back(words_of(each)); }
    return result;
  }();
  return rows[static_cast<std::size_t>(&kind - object_kinds().data())];
}

bool is_repeatable(std::string_view word) {
  static constexpr std::array<std::string_view, 6> repeatable = {"vertex", "face", "sheet", "move", "rotate", "scale"};
  return contains(repeatable, word);
}

bool is_operand(std::string_view word) { return word == "use" || kind_of(word) != nullptr; }

}  // namespace apps::scene_file
