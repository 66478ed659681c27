// SPDX-License-Identifier: MIT
#pragma once

// Operators as data: a call can be listed, applied, inverted, printed and dropped from a failing sequence.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <brep/euler_table.hpp>

#include "shapes.hpp"

namespace calls {

using brep::Code;
using brep::HalfedgeId;
using brep::Operator;

struct Call {
  Operator op{};
  HalfedgeId a{}, b{};
};

inline std::string to_string(const Call& call) {
  std::string text(name(call.op));
  for (HalfedgeId h : {call.a, call.b}) {
    if (h.valid()) { text += ' ' + brep::to_string(h); }
  }
  return text;
}
inline std::string to_string(std::span<const Call> list) {
  std::string text;
  for (const Call& call : list) { text += to_string(call) + '\n'; }
  return text;
}

[[nodiscard]] constexpr bool takes_two(Operator op) {
  return op == Operator::split_face || op == Operator::split_vertex || op == Operator::bridge || op == Operator::weld;
}

// v, e, f afterwards minus before: written from the comments in euler.hpp, not from the table.
struct Change {
  int v, e, f;
};
[[nodiscard]] inline Change change(Operator op) {
  switch (op) {
    case Operator::make_segment:
      return {2, 1, 1};
    case Operator::kill_segment:
      return {-2, -1, -1};
    case Operator::split_face:
      return {0, 1, 1};
    case Operator::join_faces:
      return {0, -1, -1};
    case Operator::split_vertex:
    case Operator::split_edge:
      return {1, 1, 0};
    case Operator::join_vertices:
      return {-1, -1, 0};
    case Operator::bridge:
      return {0, 1, -1};
    case Operator::cut:
      return {0, -1, 1};
    case Operator::weld:
      return {-1, 1, 0};
    case Operator::unweld:
      return {1, -1, 0};
    case Operator::set_anchor:
      return {0, 0, 0};
  }
  return {0, 0, 0};
}

struct Answer {
  bool done = false;
  HalfedgeId made{};        // the half-edge that an operator returned
  brep::Refusal refusal{};  // when it is not done
};

template <class B>
Answer apply(B& m, const Call& call) {
  const brep::Result<brep::Element> answer = brep::apply(m, call.op, call.a, call.b);
  Answer x{answer.has_value(), {}, answer.refusal()};
  if (x.done && answer->letter == 'h') { x.made = HalfedgeId{answer->index}; }
  return x;
}

// The call that takes `call` back, as the comments in euler.hpp give it; `before` is the BRep in which it is still to be applied, `made`
// what it will return.
template <class B>
Call inverse(const B& before, const Call& call, HalfedgeId made) {
  const HalfedgeId h = call.a, t = twin(h);
  const auto next = [&](HalfedgeId x) { return before.next(x); };
  switch (call.op) {
    case Operator::make_segment:
      return {Operator::kill_segment, made, {}};
    case Operator::split_face:
      return {Operator::join_faces, made, {}};
    case Operator::split_vertex:
      return {Operator::join_vertices, made, {}};
    case Operator::split_edge:
      return {Operator::join_vertices, twin(made), {}};
    case Operator::bridge:
      return {Operator::cut, made, {}};
    case Operator::weld:
      return {Operator::unweld, made, {}};
    case Operator::kill_segment:
      return {Operator::make_segment, {}, {}};
    case Operator::join_faces:
      return {Operator::split_face, next(t) == t ? next(h) : next(t), next(h) == h ? next(t) : next(h)};
    case Operator::join_vertices:
      return {Operator::split_vertex, next(h) == t ? next(t) : next(h), next(t) == h ? next(h) : next(t)};
    case Operator::cut:
      return {Operator::bridge, next(t), next(h)};
    case Operator::unweld:
      return {Operator::weld, next(h), next(t)};
    case Operator::set_anchor:
      return {Operator::set_anchor, before.halfedge(before.face(h)), {}};
  }
  return {};
}

// What the inverse restores: an operator that splits, or adds a shell, chose anchors so that its inverse finds every record again. One that
// kills a face or vertex forgets its anchor (only the log knows it); one that removes an edge also forgets which half came first
// and, of a one-edge face or a spur, which of two names was killed.
enum class Restores { every_record, all_but_anchors, the_shape };
template <class B>
Restores restores(const B& before, const Call& call) {
  if (call.op == Operator::bridge || call.op == Operator::weld) { return Restores::all_but_anchors; }
  if (!removes_edge(call.op)) { return Restores::every_record; }
  const bool alone = (call.op == Operator::join_faces && before.next(call.a) == call.a) ||
                     (call.op == Operator::join_vertices && before.next(twin(call.a)) == call.a);
  return call.a.index % 2 != 0 || alone ? Restores::the_shape : Restores::all_but_anchors;
}

// The refusal that euler.hpp promises, Code::none when the call is possible. Written from its comments, not from its code.
template <class B>
Code promised(const B& m, const Call& call) {
  const HalfedgeId a = call.a, t = twin(a);
  if (call.op == Operator::make_segment) { return Code::none; }
  if (!m.alive(a) || (takes_two(call.op) && !m.alive(call.b))) { return Code::dead; }
  const auto unless = [](bool possible, Code code) { return possible ? Code::none : code; };
  const bool segment = m.next(a) == t && m.next(t) == a;
  const bool sphere_with_a_loop = m.next(a) == a && m.next(t) == t;
  switch (call.op) {
    case Operator::kill_segment:
      return unless(segment, Code::not_a_segment);
    case Operator::split_face:
      return unless(m.face(a) == m.face(call.b), Code::different_faces);
    case Operator::bridge:
      return unless(m.face(a) != m.face(call.b), Code::one_face);
    case Operator::split_vertex:
      return unless(m.vertex(a) == m.vertex(call.b), Code::different_vertices);
    case Operator::weld:
      return unless(m.vertex(a) != m.vertex(call.b), Code::one_vertex);
    case Operator::join_faces:
      return m.face(a) == m.face(t) ? Code::same_face : unless(!sphere_with_a_loop, Code::last_edge);
    case Operator::join_vertices:
      return m.vertex(a) == m.target(a) ? Code::same_vertex : unless(!segment, Code::last_edge);
    case Operator::cut:
      return m.face(a) != m.face(t) ? Code::two_faces : unless(degree(m, m.vertex(a)) > 1 && degree(m, m.target(a)) > 1, Code::spur);
    case Operator::unweld:
      return m.vertex(a) != m.target(a) ? Code::two_vertices
                                        : unless(degree(m, m.face(a)) > 1 && degree(m, m.face(t)) > 1, Code::one_edge_face);
    default:
      return Code::none;
  }
}

// Shells and their handles, counted without the help of anchors and counters.
struct Shells {
  std::size_t count = 0;
  long handles = 0;
  bool closed = true;  // v - e + f of each is 2 - 2h with an integer h >= 0
};
template <class B>
Shells shells(const B& m) {
  Shells result;
  std::vector<char> seen(m.halfedge_end(), 0), vertex_seen(m.vertex_end(), 0), face_seen(m.face_end(), 0);
  std::vector<HalfedgeId> reached;
  for (std::uint32_t i = 0; i < m.halfedge_end(); i += 2) {
    if (!m.alive(HalfedgeId{i}) || seen[i]) { continue; }
    long twice_euler = 0;
    reached.assign(1, HalfedgeId{i});
    seen[i] = 1;
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const HalfedgeId h = reached[k];
      --twice_euler;
      if (!std::exchange(vertex_seen[m.vertex(h).index], 1)) { twice_euler += 2; }
      if (!std::exchange(face_seen[m.face(h).index], 1)) { twice_euler += 2; }
      for (HalfedgeId x : {twin(h), m.next(h)}) {
        if (!std::exchange(seen[x.index], 1)) { reached.push_back(x); }
      }
    }
    ++result.count;
    result.closed = result.closed && twice_euler % 4 == 0 && twice_euler <= 4;
    result.handles += (4 - twice_euler) / 4;
  }
  return result;
}

// A call that is likely to be possible; grows towards `limit` edges and shrinks beyond.
template <class B>
Call random_call(const B& m, shapes::Random& random, std::size_t limit) {
  if (m.edge_count() == 0) { return {Operator::make_segment, {}, {}}; }
  const auto any = [&] {
    for (;;) {
      const HalfedgeId h{random.below(m.halfedge_end())};
      if (m.alive(h)) { return h; }
    }
  };
  const HalfedgeId a = any();
  HalfedgeId around_face = a, around_vertex = a;
  for (std::uint32_t k = random.below(5); k > 0; --k) {
    around_face = m.next(around_face);
    around_vertex = m.next(twin(around_vertex));
  }
  const bool grow = m.edge_count() < limit ? random.below(3) != 0 : random.below(4) == 0;
  if (grow) {
    switch (random.below(12)) {
      case 0:
      case 1:
        return {Operator::make_segment, {}, {}};
      case 2:
        return {Operator::bridge, a, any()};
      case 3:
        return {Operator::weld, a, any()};
      case 4:
        return {Operator::split_edge, a, {}};
      case 5:
        return {Operator::split_face, a, any()};
      case 6:
        return {Operator::split_vertex, a, any()};
      case 7:
      case 8:
      case 9:
        return {Operator::split_face, a, around_face};
      default:
        return {Operator::split_vertex, a, around_vertex};
    }
  }
  constexpr Operator shrinking[] = {Operator::join_faces, Operator::join_vertices, Operator::join_faces, Operator::join_vertices,
                                    Operator::cut,        Operator::unweld,        Operator::set_anchor, Operator::kill_segment};
  return {shrinking[random.below(8)], a, {}};
}

// What random calls make from nothing: degenerate states, handles and several shells.
template <class B>
B random_map(shapes::Random& random, std::size_t number_of_calls) {
  B m;
  for (std::size_t i = 0; i < number_of_calls; ++i) { (void)apply(m, random_call(m, random, number_of_calls)); }
  return m;
}

// The shortest sequence that dropping steps from a failing one leads to: halves, quarters, ... and at last single steps are left out as
// long as it still fails.
template <class Fails>
std::vector<Call> shrink(std::vector<Call> list, Fails&& fails) {
  for (std::size_t length = list.size() / 2 + 1; length > 0;) {
    bool dropped = false;
    for (std::size_t begin = 0; begin < list.size();) {
      const std::size_t end = std::min(begin + length, list.size());
      std::vector<Call> shorter(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(begin));
      shorter.insert(shorter.end(), list.begin() + static_cast<std::ptrdiff_t>(end), list.end());
      if (fails(shorter)) {
        list = std::move(shorter);
        dropped = true;
      } else {
        begin = end;
      }
    }
    if (length > 1 || !dropped) { length /= 2; }
  }
  return list;
}

}  // namespace calls
