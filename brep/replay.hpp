// SPDX-License-Identifier: MIT
#pragma once

// Replay: the steps of one BRep's log, applied to another by the checked operators.

#include <cstddef>
#include <span>

#include <brep/euler_table.hpp>
#include <brep/step.hpp>

namespace brep {

// What became of a replay: the number of steps that were applied, and why the next one was not.
struct Replay {
  std::size_t done = 0;
  Refusal refusal{};  // Code::none when all were applied

  explicit operator bool() const { return refusal.code == Code::none; }
};

// Applies the steps of another BRep's log to this one, which must be as that one was at the start: same elements, same handles, same free
// lists (both empty, say); then it becomes the same, record for record. Stops at the first step that is refused or makes
// another handle than it did there; the steps before it stand.
template <class B>
Replay replay(std::span<const Step> steps, B& brep) {
  Replay result;
  for (const Step& s : steps) {
    const auto [a, b] = detail::arguments(s);
    const Result<Element> answer = apply(brep, s.op, a, b);
    Refusal refusal = answer.refusal();
    if (answer && answer->letter == 'h') {
      const HalfedgeId made = halfedge(edge(HalfedgeId{answer->index}));  // the step names the first half of the new edge
      if (made != s.h) { refusal = {Code::other_handle, {s.h, made}}; }
    }
    result.refusal = refusal;
    if (refusal.code != Code::none) { return result; }
    ++result.done;
  }
  return result;
}

}  // namespace brep
