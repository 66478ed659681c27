// SPDX-License-Identifier: MIT
#pragma once

// Pools: the paper's allocator templates (section 2.2), with indices for pointers.
//
// Two kinds of memory. Attributes lie in pages that never move, so a reference to the user's data stays valid while the element lives,
// however much the pool grows. Topology, to which nobody outside holds references, lies in one array: one load for a step of a
// walk where a page table takes two, one after the other. That makes walks twice as fast and operators a third; the price is that
// growth may copy 16 bytes a half-edge. Measured (tests/bench/README.md): realloc by an eighth is cheaper than pages even so, and
// the third way, one reserved range of addresses that is mapped as it fills, pays more for its page faults than it saves.
//
// Killed slots are kept in a list that runs through the dead slots themselves, last in first out: an operator and its
// inverse give back the same handle, and a pool in steady state allocates nothing.
//
// A record type offers `std::uint32_t& link(Record&)`: a word that is below 2^31 in every live record. In a dead slot its
// highest bit is set and the rest is the next dead slot.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace brep {

inline constexpr unsigned page_shift = 10;  // 1024 elements a page: a box pays little, a million faces a short table

// A growing array in pages of 2^Shift elements, which are constructed one by one: few elements touch only the first part of a page.
template <class T, unsigned Shift>
class Pages {
 public:
  Pages() = default;
  Pages(Pages&& other) noexcept : pages_(std::move(other.pages_)), size_(std::exchange(other.size_, 0)) { other.pages_.clear(); }
  Pages(const Pages& other) : Pages() {
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
    if ((size_ & (page_size - 1)) == 0) add_page();
    std::construct_at(pages_.back() + (size_ & (page_size - 1)), std::forward<Arguments>(arguments)...);
    ++size_;
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return pages_.size() * page_size * sizeof(T) + pages_.capacity() * sizeof(T*); }

 private:
  static constexpr std::uint32_t page_size = std::uint32_t{1} << Shift;

  void add_page() {  // the table first: a page that it has no room for would be lost
    if (pages_.size() == size_ >> Shift) pages_.push_back(nullptr);
    if (pages_.back() == nullptr) pages_.back() = std::allocator<T>().allocate(page_size);
  }

  std::vector<T*> pages_;
  std::uint32_t size_ = 0;
};

// A growing array in one block. The records are plain words, moved by realloc, which moves large blocks by their page tables alone.
template <class T>
class Array {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  Array() = default;
  Array(Array&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)), capacity_(std::exchange(other.capacity_, 0)) {}
  Array(const Array& other) {
    if (other.size_ == 0) return;
    reserve(other.size_);
    std::memcpy(static_cast<void*>(data_), other.data_, other.size_ * sizeof(T));
    size_ = other.size_;
  }
  Array& operator=(Array other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Array() { std::free(data_); }

  [[nodiscard]] T& operator[](std::uint32_t i) {
    assert(i < size_);
    return data_[i];
  }
  [[nodiscard]] const T& operator[](std::uint32_t i) const {
    assert(i < size_);
    return data_[i];
  }
  [[gnu::noinline]] void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    void* block = nullptr;
    while ((block = std::realloc(static_cast<void*>(data_), capacity * sizeof(T))) == nullptr)
      ::operator delete(::operator new(capacity * sizeof(T)));  // no memory: ends here, unless a new-handler finds some
    data_ = static_cast<T*>(block);
    capacity_ = capacity;
  }
  // Appends `count` records, which hold anything, and returns the index of the first.
  std::uint32_t extend(std::uint32_t count) {
    if (size_ + std::size_t{count} > capacity_) grow(size_ + std::size_t{count});
    return std::exchange(size_, size_ + count);
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  void grow(std::size_t least) { reserve(std::max({least, capacity_ + capacity_ / 8, std::size_t{16}})); }

  T* data_ = nullptr;
  std::uint32_t size_ = 0;
  std::size_t capacity_ = 0;
};

// In place of the pages of an empty type.
template <class T>
class NoPages {
 public:
  [[nodiscard]] T& operator[](std::uint32_t) const { return nothing_; }
  void push_back() {}
  [[nodiscard]] std::size_t bytes() const { return 0; }

 private:
  inline static T nothing_{};
};

// Slots of Group records (1, or 2 for the halves of an edge) that are given out and taken back together, and the user's Data of each
// record, which are default data in every slot that allocate() gives out.
template <class Record, class Data, std::uint32_t Group = 1>
class Pool {
 public:
  static constexpr std::uint32_t dead_bit = 0x80000000;
  static constexpr std::uint32_t end_of_list = 0x7fffffff;

  Pool() = default;
  Pool(const Pool&) = default;
  Pool& operator=(const Pool&) = default;
  Pool(Pool&& other) noexcept
      : free_(std::exchange(other.free_, end_of_list)),
        records_(std::move(other.records_)),
        count_(std::exchange(other.count_, 0)),
        data_(std::move(other.data_)) {}
  Pool& operator=(Pool&& other) noexcept {
    records_ = std::move(other.records_);
    count_ = std::exchange(other.count_, 0);
    free_ = std::exchange(other.free_, end_of_list);
    data_ = std::move(other.data_);
    return *this;
  }
  ~Pool() = default;

  [[nodiscard]] Record& operator[](std::uint32_t i) { return records_[i]; }
  [[nodiscard]] const Record& operator[](std::uint32_t i) const { return records_[i]; }
  [[nodiscard]] Data& data(std::uint32_t i) { return data_[i]; }
  [[nodiscard]] const Data& data(std::uint32_t i) const { return data_[i]; }

  // Index of the first record of a slot; its records hold whatever they held when the slot was released.
  [[nodiscard]] std::uint32_t allocate() {
    if (free_ == end_of_list) return first_use();
    ++count_;
    const std::uint32_t i = free_;
    free_ = link(records_[i]) & ~dead_bit;
    link(records_[i]) = 0;
    if constexpr (std::is_trivially_destructible_v<Data>) reset(i);
    return i;
  }
  // Data that own something let it go here, the others are overwritten when the slot is used again.
  void release(std::uint32_t i) {
    assert(alive(i) && i % Group == 0);
    if constexpr (!std::is_trivially_destructible_v<Data>) reset(i);
    link(records_[i]) = dead_bit | free_;
    free_ = i;
    --count_;
  }
  // Appends fresh slots, whatever dead ones there are, and returns the index of the first record; the caller writes the records.
  std::uint32_t append(std::uint32_t slots) {
    assert(records_.size() < end_of_list - slots * Group);
    count_ += slots;
    if constexpr (!std::is_empty_v<Data>) {
      for (std::uint32_t k = 0; k < slots * Group; ++k) data_.push_back();
    }
    return records_.extend(slots * Group);
  }
  [[nodiscard]] bool alive(std::uint32_t i) const { return i < records_.size() && (link(records_[i - i % Group]) & dead_bit) == 0; }
  [[nodiscard]] bool full() const { return free_ == end_of_list && records_.size() >= end_of_list - Group; }

  [[nodiscard]] std::uint32_t size() const { return records_.size(); }  // records, dead ones included
  [[nodiscard]] std::uint32_t count() const { return count_; }          // live slots
  [[nodiscard]] std::uint32_t first_free() const { return free_; }      // for the validator
  // What the next allocate() will return.
  [[nodiscard]] std::uint32_t next_allocated() const { return free_ != end_of_list ? free_ : records_.size(); }
  [[nodiscard]] std::size_t bytes() const { return records_.bytes() + data_.bytes(); }

 private:
  [[gnu::noinline]] std::uint32_t first_use() {  // apart, to keep the operators small
    const std::uint32_t i = append(1);
    for (std::uint32_t k = 0; k < Group; ++k) records_[i + k] = Record{};
    link(records_[i]) = 0;
    return i;
  }
  void reset(std::uint32_t i) {
    if constexpr (!std::is_empty_v<Data>) {
      for (std::uint32_t k = 0; k < Group; ++k) data_[i + k] = Data{};
    }
  }

  std::uint32_t free_ = end_of_list;
  Array<Record> records_;
  std::uint32_t count_ = 0;  // not beside free_: the compiler would join the two stores, and the next load of free_ wait for both
  [[no_unique_address]] std::conditional_t<std::is_empty_v<Data>, NoPages<Data>, Pages<Data, page_shift + Group - 1>> data_;
};

}  // namespace brep
