// SPDX-License-Identifier: MIT
#pragma once

// Writes a log as a script: one operator a line, handles for names, and on the left the half-edge that was made.
//
// The text of a whole log, parsed and run over an empty BRep, gives the same BRep, record for record.

#include <cstddef>
#include <span>
#include <string>

#include <brep/euler_table.hpp>

namespace brep {

[[nodiscard]] inline std::string to_text(const Step& s) {
  const OperatorForm& row = form(s.op);
  const auto arguments = detail::arguments(s);
  std::string text = row.result != 'h' ? "" : to_string(row.second ? twin(s.h) : s.h) + " = ";  // the step names the first half
  text += row.name;
  for (std::size_t i = 0; i < row.arguments.size(); ++i) { text += ' ' + to_string(arguments[i]); }
  return text;
}
[[nodiscard]] inline std::string to_text(std::span<const Step> steps) {
  std::string text;
  for (const Step& s : steps) { text += to_text(s) + '\n'; }
  return text;
}

}  // namespace brep
