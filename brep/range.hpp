// SPDX-License-Identifier: MIT
#pragma once

// A range made of a walk, for range-for and the algorithms of std::ranges (the library's own views do not compile with clang 14).
//
// A walk is a small type that can be copied. value() is what it stands at, step() goes on, == compares the places of two walks over the
// same elements; a default-constructed walk stands behind the last element. All walks of circulators.hpp and neighbours.hpp are such types.
// An iterator holds all that it needs, so it outlives the range that it came from.

#include <cstddef>
#include <iterator>
#include <span>  // declares enable_borrowed_range
#include <utility>

namespace brep {

template <class Walk>
class Range {
 public:
  class iterator {
   public:
    using value_type = decltype(std::declval<const Walk&>().value());
    using difference_type = std::ptrdiff_t;
    using reference = value_type;
    using pointer = const value_type*;
    using iterator_category = std::forward_iterator_tag;

    iterator() = default;
    explicit iterator(const Walk& walk) : walk_(walk) {}
    value_type operator*() const { return walk_.value(); }
    iterator& operator++() {
      walk_.step();
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) { return a.walk_ == b.walk_; }

   private:
    Walk walk_{};
  };

  explicit Range(const Walk& first) : first_(first) {}
  [[nodiscard]] iterator begin() const { return iterator(first_); }
  [[nodiscard]] iterator end() const { return iterator(); }
  [[nodiscard]] bool empty() const { return begin() == end(); }

 private:
  Walk first_;
};

}  // namespace brep

template <class Walk>
inline constexpr bool std::ranges::enable_borrowed_range<brep::Range<Walk>> = true;
