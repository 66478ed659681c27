// SPDX-License-Identifier: MIT
#include "apps/euler/words.hpp"

#include <algorithm>

#include <brep/euler_script_words.hpp>

#include "apps/scene_file/words.hpp"

namespace apps::euler {

std::vector<std::string> statement_words() {
  std::vector<std::string> words = {"undo", "redo", "raw", "expect", "refused", "set_anchor"};
  for (const brep::OperatorForm& row : brep::operator_forms) {
    words.emplace_back(row.name);
    for (const std::string_view word : row.textbook) {
      if (!word.empty()) { words.emplace_back(word); }
    }
  }
  return words;
}

std::string meant(std::string_view line, const std::vector<std::string>& known) {
  const std::size_t equals = line.find('=');
  const std::size_t begin = line.find_first_not_of(" \t", equals == line.npos ? 0 : equals + 1);
  if (begin == line.npos) { return {}; }
  const std::string_view word = line.substr(begin, line.find_first_of(" \t\r(", begin) - begin);
  if (std::find(known.begin(), known.end(), word) != known.end()) { return {}; }
  const std::vector<std::string_view> views(known.begin(), known.end());
  return scene_file::suggestion(word, views);
}

std::string meant_in(std::string_view script, std::uint32_t line) {
  for (; line > 1; --line) {
    const std::size_t end = script.find('\n');
    if (end == script.npos) { return {}; }
    script.remove_prefix(end + 1);
  }
  return meant(script.substr(0, script.find('\n')), statement_words());
}

}  // namespace apps::euler
