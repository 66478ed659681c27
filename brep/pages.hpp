// SPDX-License-Identifier: MIT
#pragma once

// Pages: a growing array whose elements never move, so that references to them stay valid while it grows (the attributes of pool.hpp). The
// first pages are small, since most boundary representations are.

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace brep {

inline constexpr unsigned page_shift = 10;       // 1024 elements a page: a million faces have a short table
inline constexpr unsigned first_page_shift = 4;  // except for the first pages, of 16, 16, 32, ... 512: a box pays little

// The default: the heap. (Not std::allocator, whose namespace would take part in the lookup of every function that is called on a BRep.)
template <class T>
struct HeapAllocator {
  using value_type = T;

  HeapAllocator() = default;
  template <class U>
  HeapAllocator(const HeapAllocator<U>&) {}  // implicit, as allocators are
  [[nodiscard]] T* allocate(std::size_t count) { return std::allocator<T>().allocate(count); }
  void deallocate(T* block, std::size_t count) { std::allocator<T>().deallocate(block, count); }
  friend bool operator==(HeapAllocator, HeapAllocator) { return true; }
};
using DefaultAllocator = HeapAllocator<char>;

// A growing array in pages of 2^Shift elements, the first 2^Shift in smaller ones, each as large as all before it.
template <class T, unsigned Shift, class Allocator>
class Pages {
  using ElementAllocator = typename std::allocator_traits<Allocator>::template rebind_alloc<T>;
  using TableAllocator = typename std::allocator_traits<Allocator>::template rebind_alloc<T*>;
  using Traits = std::allocator_traits<ElementAllocator>;

 public:
  explicit Pages(const Allocator& allocator) : pages_(TableAllocator(allocator)) {}
  Pages(Pages&& other) noexcept : pages_(std::move(other.pages_)), size_(std::exchange(other.size_, 0)) { other.pages_.clear(); }
  Pages(const Pages& other) : Pages(other, std::allocator_traits<Allocator>::select_on_container_copy_construction(other.allocator())) {}
  Pages(const Pages& other, const Allocator& allocator) : Pages(allocator) {
    for (std::uint32_t i = 0; i < other.size_; ++i) { push_back(other[i]); }
  }
  Pages(Pages&& other, const Allocator& allocator) : Pages(allocator) {
    if (pages_.get_allocator() != other.pages_.get_allocator()) {
      for (std::uint32_t i = 0; i < other.size_; ++i) { push_back(std::move(other[i])); }
      other.clear();
    } else {
      swap(other);
    }
  }
  Pages& operator=(const Pages& other) {
    Pages copy(other, allocator());
    swap(copy);
    return *this;
  }
  Pages& operator=(Pages&& other) noexcept {
    Pages taken(std::move(other), allocator());
    swap(taken);
    return *this;
  }
  ~Pages() { clear(); }

  [[nodiscard]] T& operator[](std::uint32_t i) {
    assert(i < size_);
    const Place at = place(i);
    return pages_[at.page][at.offset];
  }
  [[nodiscard]] const T& operator[](std::uint32_t i) const {
    assert(i < size_);
    const Place at = place(i);
    return pages_[at.page][at.offset];
  }
  template <class... Arguments>
  void push_back(Arguments&&... arguments) {
    const Place at = place(size_);
    if (at.offset == 0) { add_page(at.page); }
    ElementAllocator allocator(pages_.get_allocator());
    Traits::construct(allocator, pages_.back() + at.offset, std::forward<Arguments>(arguments)...);
    ++size_;
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t elements = 0;
    for (std::uint32_t page = 0; page < pages_.size(); ++page) { elements += page_size(page); }
    return elements * sizeof(T) + pages_.capacity() * sizeof(T*);
  }
  [[nodiscard]] Allocator allocator() const { return Allocator(pages_.get_allocator()); }

 private:
  static constexpr std::uint32_t first_whole = Shift - first_page_shift + 1;  // the first page of 2^Shift elements

  struct Place {
    std::uint32_t page, offset;
  };
  static Place place(std::uint32_t i) {
    if (i >> Shift != 0) { return {(i >> Shift) - 1 + first_whole, i & ((std::uint32_t{1} << Shift) - 1)}; }
    if (i >> first_page_shift == 0) { return {0, i}; }
    return {static_cast<std::uint32_t>(std::bit_width(i >> first_page_shift)), i - std::bit_floor(i)};
  }
  static std::uint32_t page_size(std::uint32_t page) {
    const unsigned smaller = page == 0 ? first_whole - 1 : page < first_whole ? first_whole - page : 0;
    return std::uint32_t{1} << (Shift - smaller);
  }
  void add_page(std::uint32_t page) {  // the table first: a page that it has no room for would be lost
    if (pages_.size() == page) { pages_.push_back(nullptr); }
    if (pages_.back() != nullptr) { return; }
    ElementAllocator allocator(pages_.get_allocator());
    pages_.back() = Traits::allocate(allocator, page_size(page));
  }
  void clear() {
    ElementAllocator allocator(pages_.get_allocator());
    if constexpr (!std::is_trivially_destructible_v<T>) {
      for (std::uint32_t i = 0; i < size_; ++i) { Traits::destroy(allocator, &(*this)[i]); }
    }
    for (std::uint32_t page = 0; page < pages_.size(); ++page) {
      if (pages_[page] != nullptr) { Traits::deallocate(allocator, pages_[page], page_size(page)); }
    }
    pages_.clear();
    size_ = 0;
  }
  void swap(Pages& other) {  // of equal allocators
    pages_.swap(other.pages_);
    std::swap(size_, other.size_);
  }

  std::vector<T*, TableAllocator> pages_;
  std::uint32_t size_ = 0;
};

}  // namespace brep
