// SPDX-License-Identifier: MIT
#pragma once

// A list of trivial values that needs no heap up to N of them: the corners of a face, the points of a polygon.
//
// Faces have three to some ten corners and are visited millions of times; beyond N the list moves to the heap, so there is
// no upper limit. Iterators and references are invalid after push_back.

#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace brep {

template <class T, std::size_t N = 16>
class SmallList {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;

  void push_back(const T& value) {
    if (heap_.empty() && size_ < N) {
      inline_[size_++] = value;
      return;
    }
    if (heap_.empty()) { heap_.assign(inline_.begin(), inline_.end()); }
    heap_.push_back(value);
    ++size_;
  }
  void clear() {
    heap_.clear();
    size_ = 0;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return heap_.empty() ? inline_.data() : heap_.data(); }
  [[nodiscard]] const T* data() const { return heap_.empty() ? inline_.data() : heap_.data(); }
  [[nodiscard]] T& operator[](std::size_t i) { return assert(i < size_), data()[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return assert(i < size_), data()[i]; }
  [[nodiscard]] T* begin() { return data(); }
  [[nodiscard]] T* end() { return data() + size_; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size_; }
  operator std::span<const T>() const { return {data(), size_}; }

 private:
  std::array<T, N> inline_{};
  std::vector<T> heap_;  // empty, or all the values
  std::size_t size_ = 0;
};

}  // namespace brep
