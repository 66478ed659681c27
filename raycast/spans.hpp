// SPDX-License-Identifier: MIT
#pragma once

// The intervals of a line inside a solid, disjoint and in increasing order. A surface without inside (a polygon) gives spans of length
// zero. The complement of a solid (a room) has spans that begin at -inf and end at +inf; these two ends belong to no sheet.
//
// Spans are made for every ray, so the first eight are stored in the object itself; heap memory is used only beyond these.

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <raycast/box.hpp>

namespace raycast {

inline constexpr std::uint32_t no_crossing_sheet = 0xffffffff;  // of the ends at infinity

struct Crossing {
  double t;
  std::uint32_t sheet;
};

struct Span {
  Crossing in, out;
};

// A sequence whose first N elements need no heap memory. T is trivial; elements are uninitialised until pushed.
template <class T, std::size_t N>
class InlineVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  InlineVector() {}  // not "= default": value-initialisation must not clear the storage
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* begin() { return heap_.empty() ? inline_.data() : heap_.data(); }
  [[nodiscard]] T* end() { return begin() + size_; }
  [[nodiscard]] const T* begin() const { return heap_.empty() ? inline_.data() : heap_.data(); }
  [[nodiscard]] const T* end() const { return begin() + size_; }
  [[nodiscard]] T& operator[](std::size_t i) { return begin()[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return begin()[i]; }
  [[nodiscard]] T& back() { return begin()[size_ - 1]; }

  void push(const T& value) {
    if (size_ < N) {
      inline_[size_] = value;
    } else {
      if (heap_.empty()) { heap_.assign(inline_.begin(), inline_.end()); }
      heap_.push_back(value);
    }
    ++size_;
  }
  void pop() {
    if (!heap_.empty()) { heap_.pop_back(); }
    --size_;
  }
  void clear() {
    heap_.clear();
    size_ = 0;
  }

 private:
  std::size_t size_ = 0;
  std::array<T, N> inline_;
  std::vector<T> heap_;  // empty, or holds all elements
};

class Spans {
 public:
  // Appends a span that begins no earlier than the last one; if it overlaps or touches the last one, both are merged. A span of
  // negative length (possible by rounding where a line grazes an edge) is dropped.
  void push(const Span& span) {
    if (!(span.in.t <= span.out.t)) { return; }
    if (!spans_.empty() && span.in.t <= spans_.back().out.t) {
      assert(span.in.t >= spans_.back().in.t);
      if (span.out.t > spans_.back().out.t) { spans_.back().out = span.out; }
      return;
    }
    spans_.push(span);
  }
  // Appends a crossing of a surface without inside, no earlier than the last one. Crossings are never merged, even if two coincide.
  void push(const Crossing& crossing) { spans_.push(Span{crossing, crossing}); }
  void clear() { spans_.clear(); }
  [[nodiscard]] std::size_t size() const { return spans_.size(); }
  [[nodiscard]] bool empty() const { return spans_.empty(); }
  [[nodiscard]] const Span* begin() const { return spans_.begin(); }
  [[nodiscard]] const Span* end() const { return spans_.end(); }
  [[nodiscard]] const Span& operator[](std::size_t i) const { return spans_[i]; }

  // Replaces the spans by their complement. Spans of length zero vanish: a line that only touches a room's wall stays in the room.
  void complement() {
    InlineVector<Span, 8> rest;
    Crossing from{-infinity, no_crossing_sheet};
    for (const Span& s : spans_) {
      if (s.in.t == s.out.t) { continue; }
      if (s.in.t > -infinity) { rest.push(Span{from, s.in}); }
      from = s.out;
    }
    if (from.t < infinity) { rest.push(Span{from, Crossing{infinity, no_crossing_sheet}}); }
    spans_ = rest;
  }

 private:
  InlineVector<Span, 8> spans_;
};

}  // namespace raycast
