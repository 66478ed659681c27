// SPDX-License-Identifier: MIT
#pragma once

// Replay: the steps of one BRep's log, applied to another by the checked operators.

#include <cstddef>
#include <span>
#include <type_traits>

#include <brep/euler.hpp>
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
    Refusal refusal;
    HalfedgeId made = s.h;
    const auto take = [&](auto&& answer) {
      refusal = answer.refusal();
      if constexpr (std::is_same_v<std::decay_t<decltype(answer)>, Result<HalfedgeId>>) made = refusal.code == Code::none ? *answer : s.h;
    };
    switch (s.op) {
      case Operator::make_segment:
        take(make_segment(brep));
        break;
      case Operator::kill_segment:
        take(kill_segment(brep, s.h));
        break;
      case Operator::split_face:
        take(split_face(brep, s.a, s.b));
        break;
      case Operator::join_faces:
        take(join_faces(brep, s.h));
        break;
      case Operator::split_vertex:
        take(split_vertex(brep, s.a, s.b));
        break;
      case Operator::join_vertices:
        take(join_vertices(brep, s.h));
        break;
      case Operator::split_edge:
        take(split_edge(brep, s.a));
        made = twin(made);  // the step names the first half of the new edge
        break;
      case Operator::bridge:
        take(bridge(brep, s.a, s.b));
        break;
      case Operator::cut:
        take(cut(brep, s.h));
        break;
      case Operator::weld:
        take(weld(brep, s.a, s.b));
        break;
      case Operator::unweld:
        take(unweld(brep, s.h));
        break;
      case Operator::set_anchor:
        if (brep.alive(s.h))
          brep.set_anchor(brep.face(s.h), s.h);
        else
          refusal = {Code::dead, {s.h}};
        break;
    }
    if (refusal.code == Code::none && made != s.h) refusal = {Code::other_handle, {s.h, made}};
    result.refusal = refusal;
    if (refusal.code != Code::none) return result;
    ++result.done;
  }
  return result;
}

}  // namespace brep
