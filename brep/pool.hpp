// SPDX-License-Identifier: MIT
#pragma once

// Paged pools: the paper's allocator templates (section 2.2), with indices for pointers.
//
// Pages never move, so a reference to a record stays valid while the element lives, however much the pool grows; growth
// never copies. Killed slots are kept in a list that runs through the dead slots themselves, last in first out: an
// operator and its inverse give back the same handle, and a pool in steady state allocates nothing.
//
// A record type offers `std::uint32_t& link(Record&)`: a word that is below 2^31 in every live record. In a dead slot its
// highest bit is set and the rest is the next dead slot.
//
// Records are constructed when their slot is first used and live until the pool ends, so a pool of few elements
// touches only the first part of its page.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace brep {

inline constexpr unsigned page_shift = 10;  // 1024 elements a page: a box pays little, a million faces a short table

// A growing array in pages of 2^Shift elements.
template <class T, unsigned Shift>
class Pages {
 public:
  Pages() = default;
  Pages(Pages&& other) noexcept : pages_(std::move(other.pages_)), size_(std::exchange(other.size_, 0)) { other.pages_.clear(); }
  Pages(const Pages& other) {
    for (std::uint32_t i = 0; i < other.size_; ++i) push_back(other[i]);
  }
  Pages& operator=(Pages other) noexcept {
    std::swap(pages_, other.pages_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~Pages() {
    if constexpr (!std::is_trivially_destructible_v<T>) {
      for (std::uint32_t i = 0; i < size_; ++i) std::destroy_at(&(*this)[i]);
    }
    for (T* page : pages_) std::allocator<T>().deallocate(page, page_size);
  }

  [[nodiscard]] T& operator[](std::uint32_t i) {
    assert(i < size_);
    return pages_[i >> Shift][i & (page_size - 1)];
  }
  [[nodiscard]] const T& operator[](std::uint32_t i) const {
    assert(i < size_);
    return pages_[i >> Shift][i & (page_size - 1)];
  }
  template <class... Arguments>
  void push_back(Arguments&&... arguments) {
    if ((size_ & (page_size - 1)) == 0) pages_.push_back(std::allocator<T>().allocate(page_size));
    std::construct_at(pages_.back() + (size_ & (page_size - 1)), std::forward<Arguments>(arguments)...);
    ++size_;
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return pages_.size() * page_size * sizeof(T) + pages_.capacity() * sizeof(T*); }

 private:
  static constexpr std::uint32_t page_size = std::uint32_t{1} << Shift;
  std::vector<T*> pages_;
  std::uint32_t size_ = 0;
};

// Slots of Group records (1, or 2 for the halves of an edge) that are given out and taken back together.
template <class Record, std::uint32_t Group = 1>
class Pool {
 public:
  static constexpr std::uint32_t dead_bit = 0x80000000;
  static constexpr std::uint32_t end_of_list = 0x7fffffff;

  Pool() = default;
  Pool(const Pool&) = default;
  Pool& operator=(const Pool&) = default;
  Pool(Pool&& other) noexcept
      : records_(std::move(other.records_)), count_(std::exchange(other.count_, 0)), free_(std::exchange(other.free_, end_of_list)) {}
  Pool& operator=(Pool&& other) noexcept {
    records_ = std::move(other.records_);
    count_ = std::exchange(other.count_, 0);
    free_ = std::exchange(other.free_, end_of_list);
    return *this;
  }
  ~Pool() = default;

  [[nodiscard]] Record& operator[](std::uint32_t i) { return records_[i]; }
  [[nodiscard]] const Record& operator[](std::uint32_t i) const { return records_[i]; }

  // What the next allocate() will return.
  [[nodiscard]] std::uint32_t next_allocated() const { return free_ != end_of_list ? free_ : records_.size(); }
  // Index of the first record of a slot; its records hold whatever they held when the slot was released.
  [[nodiscard]] std::uint32_t allocate() {
    ++count_;
    if (free_ != end_of_list) {
      const std::uint32_t i = free_;
      free_ = link(records_[i]) & ~dead_bit;
      link(records_[i]) = 0;
      return i;
    }
    const std::uint32_t i = records_.size();
    assert(i < end_of_list - Group);
    for (std::uint32_t k = 0; k < Group; ++k) records_.push_back();
    link(records_[i]) = 0;
    return i;
  }
  void release(std::uint32_t i) {
    assert(alive(i) && i % Group == 0);
    link(records_[i]) = dead_bit | free_;
    free_ = i;
    --count_;
  }
  [[nodiscard]] bool alive(std::uint32_t i) const { return i < records_.size() && (link(records_[i - i % Group]) & dead_bit) == 0; }
  [[nodiscard]] bool full() const { return free_ == end_of_list && records_.size() >= end_of_list - Group; }

  [[nodiscard]] std::uint32_t size() const { return records_.size(); }  // records, dead ones included
  [[nodiscard]] std::uint32_t count() const { return count_; }          // live slots
  [[nodiscard]] std::uint32_t first_free() const { return free_; }      // for the validator
  [[nodiscard]] std::size_t bytes() const { return records_.bytes(); }

 private:
  Pages<Record, page_shift + Group - 1> records_;
  std::uint32_t count_ = 0;
  std::uint32_t free_ = end_of_list;
};

}  // namespace brep
