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
// element comes back under its own handle. (A slot first used since stays, free, and is given out when a fresh one would be.) Data of
// killed elements are kept and come back too; what the user wrote into the data of living elements is not logged. Records that are
// written without an operator (Raw, the assignment of another BRep) are not seen.
//
// A step is 32 bytes. A BRep with NoLog pays nothing.

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <brep/euler_table.hpp>

namespace brep {

struct EulerLog {
  template <class VertexT, class HalfedgeT, class FaceT, class Allocator>
  class For;
};

template <class VertexT, class HalfedgeT, class FaceT, class Allocator>
class EulerLog::For {
  template <class T>
  using List = std::vector<T, typename std::allocator_traits<Allocator>::template rebind_alloc<T>>;

 public:
  enum class Mode { recording, undoing, redoing };

  List<Step> past, future;  // future: undone steps, the next one to redo at the end
  Mode mode = Mode::recording;

  explicit For(const Allocator& a) : past(a), future(a), data_of_past_(a), data_of_future_(a) {}
  For(const For& other, const Allocator& a)
      : past(other.past, a), future(other.future, a), data_of_past_(other.data_of_past_, a), data_of_future_(other.data_of_future_, a) {}
  For(For&& other, const Allocator& a)
      : past(std::move(other.past), a),
        future(std::move(other.future), a),
        data_of_past_(std::move(other.data_of_past_), a),
        data_of_future_(std::move(other.data_of_future_), a) {}

  void record(const Step& step) {
    if (mode != Mode::recording) { return; }
    past.push_back(step);
    if (future.empty()) { return; }
    future.clear();
    data_of_future_.clear();
  }
  // Data of a killed element, and of one that comes back. Steps nest, hence stacks.
  template <class T>
  void keep(T& data) {
    if constexpr (!std::is_empty_v<T>) { stack<T>(mode == Mode::undoing ? data_of_future_ : data_of_past_).push_back(std::move(data)); }
  }
  template <class T>
  void give_back(T& data) {
    if constexpr (!std::is_empty_v<T>) {
      if (mode == Mode::recording) { return; }
      auto& kept = stack<T>(mode == Mode::undoing ? data_of_past_ : data_of_future_);
      data = std::move(kept.back());
      kept.pop_back();
    }
  }

 private:
  struct Data {
    List<VertexT> vertices;
    List<HalfedgeT> halfedges;
    List<FaceT> faces;

    explicit Data(const Allocator& a) : vertices(a), halfedges(a), faces(a) {}
    Data(const Data& other, const Allocator& a) : vertices(other.vertices, a), halfedges(other.halfedges, a), faces(other.faces, a) {}
    Data(Data&& other, const Allocator& a)
        : vertices(std::move(other.vertices), a), halfedges(std::move(other.halfedges), a), faces(std::move(other.faces), a) {}
    void clear() {
      vertices.clear();
      halfedges.clear();
      faces.clear();
    }
  };
  template <class T>
  static List<T>& stack(Data& data) {  // types that are the same share a stack
    if constexpr (std::is_same_v<T, VertexT>) {
      return data.vertices;
    } else if constexpr (std::is_same_v<T, HalfedgeT>) {
      return data.halfedges;
    } else {
      return data.faces;
    }
  }
  Data data_of_past_, data_of_future_;
};

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
  if (log.past.empty()) { return false; }
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
  if (log.future.empty()) { return false; }
  log.mode = std::decay_t<decltype(log)>::Mode::redoing;
  const Step step = log.future.back();
  log.future.pop_back();
  const auto [a, b] = detail::arguments(step);
  [[maybe_unused]] const auto answer = apply(brep, step.op, a, b);
  assert(answer);
  log.past.push_back(step);
  log.mode = std::decay_t<decltype(log)>::Mode::recording;
  return true;
}

// Undoes, or redoes, until `mark` steps stand. False when there were never so many: then all that can be redone is.
template <class B>
bool undo_to(B& brep, std::size_t mark) requires(B::logs) {
  while (brep::mark(brep) > mark) { undo(brep); }
  while (brep::mark(brep) < mark) {
    if (!redo(brep)) { return false; }
  }
  return true;
}

}  // namespace brep
