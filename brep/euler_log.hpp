// SPDX-License-Identifier: MIT
#pragma once

// The log of the Euler operators: undo and redo. (replay.hpp applies a log to another BRep.)
//
//   BRep<V, H, F, EulerLog> brep;
//   const std::size_t before = mark(brep);
//   ... any operators ...
//   undo_to(brep, before);     every record is what it was, anchors and free lists included
//   while (redo(brep)) {}      and again
//
// Undo runs the inverse operator (Mäntylä 1988, ch. 9) and puts the anchors back; pools hand slots out last in first out, so every
// element comes back under its own handle. (A slot first used since stays, free, and is given out when a fresh one would be.) Data of killed elements are kept and come back too; what the user wrote into the data
// of living elements is not logged. Records that are written without an operator (Raw, the assignment of another BRep) are not seen.
//
// A step is 32 bytes. A BRep with NoLog pays nothing.

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <brep/euler.hpp>

namespace brep {

struct EulerLog {
  template <class VertexT, class HalfedgeT, class FaceT>
  class For;
};

template <class VertexT, class HalfedgeT, class FaceT>
class EulerLog::For {
 public:
  enum class Mode { recording, undoing, redoing };

  std::vector<Step> past, future;  // future: undone steps, the next one to redo at the end
  Mode mode = Mode::recording;

  void record(const Step& step) {
    if (mode != Mode::recording) return;
    past.push_back(step);
    if (future.empty()) return;
    future.clear();
    data_of_future_ = {};
  }
  // Data of a killed element, and of one that comes back. Steps nest, hence stacks.
  template <class T>
  void keep(T& data) {
    if constexpr (!std::is_empty_v<T>) stack<T>(mode == Mode::undoing ? data_of_future_ : data_of_past_).push_back(std::move(data));
  }
  template <class T>
  void give_back(T& data) {
    if constexpr (!std::is_empty_v<T>) {
      if (mode == Mode::recording) return;
      auto& kept = stack<T>(mode == Mode::undoing ? data_of_past_ : data_of_future_);
      data = std::move(kept.back());
      kept.pop_back();
    }
  }

 private:
  struct Data {
    std::vector<VertexT> vertices;
    std::vector<HalfedgeT> halfedges;
    std::vector<FaceT> faces;
  };
  template <class T>
  static std::vector<T>& stack(Data& data) {  // types that are the same share a stack
    if constexpr (std::is_same_v<T, VertexT>)
      return data.vertices;
    else if constexpr (std::is_same_v<T, HalfedgeT>)
      return data.halfedges;
    else
      return data.faces;
  }
  Data data_of_past_, data_of_future_;
};

namespace detail {

// Applies a step again; the BRep is in the state in which the step was recorded.
template <class B>
void apply(B& brep, const Step& s) {
  switch (s.op) {
    case Operator::make_segment:
      unchecked::make_segment(brep);
      break;
    case Operator::kill_segment:
      unchecked::kill_segment(brep, s.h);
      break;
    case Operator::split_face:
      unchecked::split_face(brep, s.a, s.b);
      break;
    case Operator::join_faces:
      unchecked::join_faces(brep, s.h);
      break;
    case Operator::split_vertex:
      unchecked::split_vertex(brep, s.a, s.b);
      break;
    case Operator::join_vertices:
      unchecked::join_vertices(brep, s.h);
      break;
    case Operator::split_edge:
      unchecked::split_edge(brep, s.a);
      break;
    case Operator::bridge:
      unchecked::bridge(brep, s.a, s.b);
      break;
    case Operator::cut:
      unchecked::cut(brep, s.h);
      break;
    case Operator::weld:
      unchecked::weld(brep, s.a, s.b);
      break;
    case Operator::unweld:
      unchecked::unweld(brep, s.h);
      break;
    case Operator::set_anchor:
      brep.set_anchor(brep.face(s.h), s.h);
      break;
  }
}

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

template <class B>
void undo(B& brep, const Step& s) {
  switch (s.op) {
    case Operator::make_segment:
      unchecked::kill_segment(brep, s.h);
      return;
    case Operator::kill_segment:
      unchecked::make_segment(brep);
      break;
    case Operator::split_face:
      unchecked::join_faces(brep, s.h);
      break;
    case Operator::join_faces:
      undo_join_faces(brep, s);
      break;
    case Operator::split_vertex:
    case Operator::split_edge:
      unchecked::join_vertices(brep, s.h);
      break;
    case Operator::join_vertices:
      undo_join_vertices(brep, s);
      break;
    case Operator::bridge:
      unchecked::cut(brep, s.h);
      break;
    case Operator::cut:
      undo_cut(brep, s);
      break;
    case Operator::weld:
      unchecked::unweld(brep, s.h);
      break;
    case Operator::unweld:
      undo_unweld(brep, s);
      break;
    case Operator::set_anchor:
      brep.set_anchor(brep.face(s.h), s.a);
      return;
  }
  const HalfedgeId p = removes_edge(s.op) ? s.h : s.a, q = removes_edge(s.op) ? twin(s.h) : s.b;
  Raw::at(brep, brep.face(p)).halfedge = s.face_a;
  Raw::at(brep, brep.face(q)).halfedge = s.face_b;
  Raw::at(brep, brep.vertex(p)).halfedge = s.vertex_a;
  Raw::at(brep, brep.vertex(q)).halfedge = s.vertex_b;
}

}  // namespace detail

// The steps that lead from the start to the present state.
template <class B>
[[nodiscard]] std::span<const Step> steps(const B& brep) requires(B::logs) {
  return detail::Raw::log(brep).past;
}

// The present place in the log, for undo_to: the number of steps.
template <class B>
[[nodiscard]] std::size_t mark(const B& brep) requires(B::logs) {
  return steps(brep).size();
}

// Takes the last step back; false when there is none.
template <class B>
bool undo(B& brep) requires(B::logs) {
  auto& log = detail::Raw::log(brep);
  if (log.past.empty()) return false;
  log.mode = std::decay_t<decltype(log)>::Mode::undoing;
  const Step step = log.past.back();
  log.past.pop_back();
  detail::undo(brep, step);
  log.future.push_back(step);
  log.mode = std::decay_t<decltype(log)>::Mode::recording;
  return true;
}

// Applies the step that was undone last again; false when there is none, as after every new operator.
template <class B>
bool redo(B& brep) requires(B::logs) {
  auto& log = detail::Raw::log(brep);
  if (log.future.empty()) return false;
  log.mode = std::decay_t<decltype(log)>::Mode::redoing;
  const Step step = log.future.back();
  log.future.pop_back();
  detail::apply(brep, step);
  log.past.push_back(step);
  log.mode = std::decay_t<decltype(log)>::Mode::recording;
  return true;
}

// Undoes, or redoes, until `mark` steps stand. False when there were never so many: then all that can be redone is.
template <class B>
bool undo_to(B& brep, std::size_t mark) requires(B::logs) {
  while (brep::mark(brep) > mark) undo(brep);
  while (brep::mark(brep) < mark) {
    if (!redo(brep)) return false;
  }
  return true;
}

}  // namespace brep
