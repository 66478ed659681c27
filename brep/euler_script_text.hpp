// SPDX-License-Identifier: MIT
#pragma once

// Writes a log as a script: one operator a line, handles for names, and on the left the half-edge that was made.
//
// The text of a whole log, parsed and run over an empty BRep, gives the same BRep, record for record.

#include <span>
#include <string>

#include <brep/euler_script.hpp>

namespace brep {

[[nodiscard]] inline std::string to_text(const Step& s) {
  const std::string name = brep::name(s.op);
  const std::string made = to_string(s.h) + " = " + name;
  if (removes_edge(s.op) || s.op == Operator::set_anchor) return name + ' ' + to_string(s.h);
  if (s.op == Operator::make_segment) return made;
  // split_edge returns the half that goes on; the step names the first half of the new edge.
  if (s.op == Operator::split_edge) return to_string(twin(s.h)) + " = " + name + ' ' + to_string(s.a);
  return made + ' ' + to_string(s.a) + ' ' + to_string(s.b);
}
[[nodiscard]] inline std::string to_text(std::span<const Step> steps) {
  std::string text;
  for (const Step& s : steps) text += to_text(s) + '\n';
  return text;
}

}  // namespace brep
