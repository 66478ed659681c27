// SPDX-License-Identifier: MIT
#pragma once

// The Euler operators as a table: one row for each, with its names, its arguments, what it does and how that is taken back.
//
// The script language (words, parsing, running, text), the log (undo, redo), replay and the help of `halflight euler` read this table
// and name no operator themselves. So a new operator takes a function in unchecked.hpp, its checked twin in euler.hpp, its name in
// Operator (step.hpp), which the function writes into the log, and a row here.
//
// Textbook names (Baumgart 1974; Mäntylä 1988, ch. 9): m make, k kill; v vertex, e edge, f face, s shell, h hole, r ring. A ring is
// a second loop of a face. Faces here have one loop (paper 2.1), and no shell is without an edge, so where the textbook needs two
// operators with a ring or a bare vertex in between, one does both: make_segment is mvfs and then mev, bridge is kfmrh and then mekr, cut
// is kemr and then mfkrh. Either name of such a pair means the one operator.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include <brep/euler.hpp>
#include <brep/step.hpp>

namespace brep {

struct OperatorForm {
  Operator op;
  std::string_view name;
  std::array<std::string_view, 2> textbook;  // words for it that are accepted; empty where the textbook has none
  std::string_view arguments;                // their kinds as letters of handles
  char result;                               // the kind of the result as a letter; 0 when there is none
  int v, e, f;                               // counts afterwards minus before
  std::string_view where;                    // for the help: what must hold of the arguments a and b, or h, or what they are for
  std::string_view steps = {};               // what does the same in the textbook, where its words alone do less
  bool second = false;                       // the result is the second half of the new edge
};

// apply(brep, a, b) is the checked operator; what it does not take is ignored. inverse(brep, step) takes back a step that was the last
// one; the anchors that the step remembers are put back by its caller.
template <class Apply, class Inverse>
struct OperatorRow : OperatorForm {
  Apply apply;
  Inverse inverse;

  constexpr OperatorRow(OperatorForm form, Apply does, Inverse undoes) : OperatorForm(form), apply(does), inverse(undoes) {}
};

namespace detail {

// The inverses of the operators that remove an edge, with the old names. Slots come back last in first out.
template <class B>
void undo_join_faces(B& brep, const Step& s) {
  (void)Raw::new_edge(brep);
  const FaceId g = Raw::new_face(brep), f = brep.face(s.a);
  s.alone ? insert_edge(brep, twin(s.h), s.a, s.a, f) : insert_edge(brep, s.h, s.a, s.b, g);
  rename_loop(brep, twin(s.h), twin(s.h), g);
}
template <class B>
void undo_join_vertices(B& brep, const Step& s) {
  (void)Raw::new_edge(brep);
  const VertexId w = Raw::new_vertex(brep), v = brep.vertex(s.a);
  s.alone ? expand_edge(brep, twin(s.h), s.a, s.a, v) : expand_edge(brep, s.h, s.a, s.b, w);
  rename_orbit(brep, twin(s.h), twin(s.h), w);
}
template <class B>
void undo_cut(B& brep, const Step& s) {
  (void)Raw::new_edge(brep);
  const FaceId f = brep.face(s.a), g = brep.face(s.b);
  rename_loop(brep, s.b, s.b, f);
  insert_edge(brep, s.h, s.a, s.b, f);
  Raw::kill(brep, g);
}
template <class B>
void undo_unweld(B& brep, const Step& s) {
  (void)Raw::new_edge(brep);
  const VertexId v = brep.vertex(s.a), w = brep.vertex(s.b);
  rename_orbit(brep, s.b, s.b, v);
  expand_edge(brep, s.h, s.a, s.b, v);
  Raw::kill(brep, w);
}

// set_anchor of brep.hpp with the question whether h is alive.
template <class B>
Result<bool> checked_set_anchor(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  brep.set_anchor(brep.face(h), h);
  return true;
}

using H = HalfedgeId;

}  // namespace detail

inline constexpr std::tuple operator_table{
    OperatorRow(
        {Operator::make_segment, "make_segment", {"mvfs"}, "", 'h', 2, 1, 1, "", "mvfs, then mev"},
        [](auto& brep, detail::H, detail::H) { return make_segment(brep); },
        [](auto& brep, const Step& s) { unchecked::kill_segment(brep, s.h); }),
    OperatorRow(
        {Operator::kill_segment, "kill_segment", {"kvfs"}, "h", 0, -2, -1, -1, "h the only edge of its shell", "kev, then kvfs"},
        [](auto& brep, detail::H h, detail::H) { return kill_segment(brep, h); },
        [](auto& brep, const Step&) { unchecked::make_segment(brep); }),
    OperatorRow(
        {Operator::split_face, "split_face", {"mef"}, "hh", 'h', 0, 1, 1, "a, b on one face"},
        [](auto& brep, detail::H a, detail::H b) { return split_face(brep, a, b); },
        [](auto& brep, const Step& s) { unchecked::join_faces(brep, s.h); }),
    OperatorRow(
        {Operator::join_faces, "join_faces", {"kef"}, "h", 'f', 0, -1, -1, "h between two faces"},
        [](auto& brep, detail::H h, detail::H) { return join_faces(brep, h); },
        [](auto& brep, const Step& s) { detail::undo_join_faces(brep, s); }),
    OperatorRow(
        {Operator::split_vertex, "split_vertex", {"mev"}, "hh", 'h', 1, 1, 0, "a, b leave one vertex; a a: a spur"},
        [](auto& brep, detail::H a, detail::H b) { return split_vertex(brep, a, b); },
        [](auto& brep, const Step& s) { unchecked::join_vertices(brep, s.h); }),
    OperatorRow(
        {Operator::join_vertices, "join_vertices", {"kev"}, "h", 'v', -1, -1, 0, "h between two vertices"},
        [](auto& brep, detail::H h, detail::H) { return join_vertices(brep, h); },
        [](auto& brep, const Step& s) { detail::undo_join_vertices(brep, s); }),
    OperatorRow(
        {Operator::split_edge, "split_edge", {}, "h", 'h', 1, 1, 0, "the result leaves the new vertex", {}, true},
        [](auto& brep, detail::H h, detail::H) { return split_edge(brep, h); },
        [](auto& brep, const Step& s) { unchecked::join_vertices(brep, s.h); }),
    OperatorRow(
        {Operator::bridge, "bridge", {"mekr", "kfmrh"}, "hh", 'h', 0, 1, -1, "a, b on different faces", "kfmrh, then mekr"},
        [](auto& brep, detail::H a, detail::H b) { return bridge(brep, a, b); },
        [](auto& brep, const Step& s) { unchecked::cut(brep, s.h); }),
    OperatorRow(
        {Operator::cut, "cut", {"kemr", "mfkrh"}, "h", 'f', 0, -1, 1, "h with one face on both sides", "kemr, then mfkrh"},
        [](auto& brep, detail::H h, detail::H) { return cut(brep, h); }, [](auto& brep, const Step& s) { detail::undo_cut(brep, s); }),
    OperatorRow(
        {Operator::weld, "weld", {}, "hh", 'h', -1, 1, 0, "a, b leave different vertices"},
        [](auto& brep, detail::H a, detail::H b) { return weld(brep, a, b); },
        [](auto& brep, const Step& s) { unchecked::unweld(brep, s.h); }),
    OperatorRow(
        {Operator::unweld, "unweld", {}, "h", 'v', 1, -1, 0, "h a loop"},
        [](auto& brep, detail::H h, detail::H) { return unweld(brep, h); },
        [](auto& brep, const Step& s) { detail::undo_unweld(brep, s); }),
    OperatorRow(
        {Operator::set_anchor, "set_anchor", {}, "h", 0, 0, 0, 0, "the walk around its face begins at h"},
        [](auto& brep, detail::H h, detail::H) { return detail::checked_set_anchor(brep, h); },
        [](auto& brep, const Step& s) { brep.set_anchor(brep.face(s.h), s.a); }),
};

// The rows without what they do.
inline constexpr auto operator_forms =
    std::apply([](const auto&... row) { return std::array<OperatorForm, sizeof...(row)>{row...}; }, operator_table);

static_assert([] {
  for (std::size_t i = 0; i < operator_forms.size(); ++i) {
    if (static_cast<std::size_t>(operator_forms[i].op) != i) { return false; }
  }
  return static_cast<std::size_t>(Operator::set_anchor) + 1 == operator_forms.size();
}());

[[nodiscard]] constexpr const OperatorForm& form(Operator op) { return operator_forms[static_cast<std::size_t>(op)]; }
[[nodiscard]] constexpr std::string_view name(Operator op) { return form(op).name; }
// Does the operator take one half-edge, h, and remove its edge?
[[nodiscard]] constexpr bool removes_edge(Operator op) { return form(op).e < 0; }
[[nodiscard]] constexpr bool adds_edge(Operator op) { return form(op).e > 0; }

// The row that has this name or textbook name; nullptr when none has.
[[nodiscard]] constexpr const OperatorForm* find_operator(std::string_view word) {
  if (word.empty()) { return nullptr; }
  for (const OperatorForm& row : operator_forms) {
    if (row.name == word || std::find(row.textbook.begin(), row.textbook.end(), word) != row.textbook.end()) { return &row; }
  }
  return nullptr;
}

namespace detail {

// Pointers to what the rows do with one type of BRep.
template <class B>
class Dispatch {
  template <class T>
  static Result<Element> as_element(const Result<T>& result) {
    if (!result) { return result.refusal(); }
    if constexpr (std::is_same_v<T, bool>) {
      return Element{};
    } else {
      return Element(*result);
    }
  }
  template <std::size_t row>
  static Result<Element> apply_row(B& brep, HalfedgeId a, HalfedgeId b) {
    return as_element(std::get<row>(operator_table).apply(brep, a, b));
  }
  template <std::size_t row>
  static void inverse_row(B& brep, const Step& step) {
    std::get<row>(operator_table).inverse(brep, step);
  }
  template <std::size_t... row>
  static constexpr auto all_apply(std::index_sequence<row...>) {
    return std::array{&apply_row<row>...};
  }
  template <std::size_t... row>
  static constexpr auto all_inverse(std::index_sequence<row...>) {
    return std::array{&inverse_row<row>...};
  }
  using Rows = std::make_index_sequence<operator_forms.size()>;

 public:
  static constexpr auto apply = all_apply(Rows());
  static constexpr auto inverse = all_inverse(Rows());
};

// The arguments with which a step was asked for.
[[nodiscard]] constexpr std::array<HalfedgeId, 2> arguments(const Step& s) {
  return adds_edge(s.op) ? std::array{s.a, s.b} : std::array{s.h, HalfedgeId{}};
}

// Takes back a step that was the last one: the inverse, then the anchors.
template <class B>
void undo(B& brep, const Step& s) {
  Dispatch<B>::inverse[static_cast<std::size_t>(s.op)](brep, s);
  if (!s.face_a.valid()) { return; }
  const HalfedgeId p = removes_edge(s.op) ? s.h : s.a, q = removes_edge(s.op) ? twin(s.h) : s.b;
  Raw::at(brep, brep.face(p)).halfedge = s.face_a;
  Raw::at(brep, brep.face(q)).halfedge = s.face_b;
  Raw::at(brep, brep.vertex(p)).halfedge = s.vertex_a;
  Raw::at(brep, brep.vertex(q)).halfedge = s.vertex_b;
}

}  // namespace detail

// Asks for an operator by its row. The result as an element: nothing for operators that return none; or the refusal.
template <class B>
Result<Element> apply(B& brep, Operator op, HalfedgeId a = {}, HalfedgeId b = {}) {
  return detail::Dispatch<B>::apply[static_cast<std::size_t>(op)](brep, a, b);
}

}  // namespace brep
