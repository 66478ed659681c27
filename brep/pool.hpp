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
// All memory comes from the user's allocator, a copy of which each pool holds. As with the polymorphic allocators of the standard, a pool
// keeps its allocator when it is assigned to; what cannot be handed over from another's memory is copied or moved one by one.
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

#include <brep/pages.hpp>

namespace brep {

// A growing array in one block. The records are plain words. The default allocator grows it by realloc, which moves large blocks by their
// page tables alone, so an eighth more is enough each time; other allocators copy, and get twice the room.
template <class T, class Allocator>
class Array {
  using ElementAllocator = typename std::allocator_traits<Allocator>::template rebind_alloc<T>;
  using Traits = std::allocator_traits<ElementAllocator>;
  static constexpr bool reallocates = std::is_same_v<ElementAllocator, HeapAllocator<T>>;

 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  explicit Array(const Allocator& allocator) : allocator_(allocator) {}
  Array(Array&& other) noexcept : allocator_(other.allocator_) { swap(other); }
  Array(const Array& other) : Array(other, std::allocator_traits<Allocator>::select_on_container_copy_construction(other.allocator())) {}
  Array(const Array& other, const Allocator& allocator) : Array(allocator) {
    if (other.size_ == 0) { return; }
    reserve(other.size_);
    std::memcpy(static_cast<void*>(data_), other.data_, other.size_ * sizeof(T));
    size_ = other.size_;
  }
  Array(Array&& other, const Allocator& allocator) : Array(allocator) {
    if (allocator_ != other.allocator_) {
      *this = static_cast<const Array&>(other);
      Array(other.allocator()).swap(other);
    } else {
      swap(other);
    }
  }
  Array& operator=(const Array& other) {
    Array(other, allocator()).swap(*this);
    return *this;
  }
  Array& operator=(Array&& other) noexcept {
    Array(std::move(other), allocator()).swap(*this);
    return *this;
  }
  ~Array() { free(); }

  [[nodiscard]] T& operator[](std::uint32_t i) {
    assert(i < size_);
    return data_[i];
  }
  [[nodiscard]] const T& operator[](std::uint32_t i) const {
    assert(i < size_);
    return data_[i];
  }
  [[gnu::noinline]] void reserve(std::size_t capacity) {
    if (capacity <= capacity_) { return; }
    if constexpr (reallocates) {
      void* block = nullptr;
      while ((block = std::realloc(static_cast<void*>(data_), capacity * sizeof(T))) == nullptr) {
        ::operator delete(::operator new(capacity * sizeof(T)));  // no memory: ends here, unless a new-handler finds some
      }
      data_ = static_cast<T*>(block);
    } else {
      T* const block = Traits::allocate(allocator_, capacity);
      if (size_ != 0) { std::memcpy(static_cast<void*>(block), data_, size_ * sizeof(T)); }
      free();
      data_ = block;
    }
    capacity_ = capacity;
  }
  // Appends `count` records, which hold anything, and returns the index of the first.
  std::uint32_t extend(std::uint32_t count) {
    if (size_ + std::size_t{count} > capacity_) { grow(size_ + std::size_t{count}); }
    return std::exchange(size_, size_ + count);
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }
  [[nodiscard]] Allocator allocator() const { return Allocator(allocator_); }

 private:
  void grow(std::size_t least) { reserve(std::max({least, capacity_ + capacity_ / (reallocates ? 8 : 1), std::size_t{16}})); }
  void free() {
    if constexpr (reallocates) {
      std::free(data_);
    } else if (data_ != nullptr) {
      Traits::deallocate(allocator_, data_, capacity_);
    }
  }
  void swap(Array& other) {  // of equal allocators
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  T* data_ = nullptr;
  std::uint32_t size_ = 0;
  [[no_unique_address]] ElementAllocator allocator_;
  std::size_t capacity_ = 0;
};

// In place of the pages of an empty type.
template <class T, class Allocator>
class NoPages {
 public:
  explicit NoPages(const Allocator&) {}
  NoPages(const NoPages&, const Allocator&) {}
  [[nodiscard]] T& operator[](std::uint32_t) const { return nothing_; }
  void push_back() {}
  [[nodiscard]] std::size_t bytes() const { return 0; }

 private:
  inline static T nothing_{};
};

// Slots of Group records (1, or 2 for the halves of an edge) that are given out and taken back together, and the user's Data of each
// record, which are default data in every slot that allocate() gives out.
template <class Record, class Data, std::uint32_t Group = 1, class Allocator = DefaultAllocator>
class Pool {
 public:
  static constexpr std::uint32_t dead_bit = 0x80000000;
  static constexpr std::uint32_t end_of_list = 0x7fffffff;

  Pool() : Pool(Allocator()) {}
  explicit Pool(const Allocator& allocator) : records_(allocator), data_(allocator) {}
  Pool(const Pool&) = default;
  Pool(const Pool& other, const Allocator& allocator)
      : free_(other.free_), records_(other.records_, allocator), count_(other.count_), data_(other.data_, allocator) {}
  Pool& operator=(const Pool&) = default;
  Pool(Pool&& other) noexcept
      : free_(std::exchange(other.free_, end_of_list)),
        records_(std::move(other.records_)),
        count_(std::exchange(other.count_, 0)),
        data_(std::move(other.data_)) {}
  Pool(Pool&& other, const Allocator& allocator)
      : free_(std::exchange(other.free_, end_of_list)),
        records_(std::move(other.records_), allocator),
        count_(std::exchange(other.count_, 0)),
        data_(std::move(other.data_), allocator) {}
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
    if (free_ == end_of_list) { return first_use(); }
    ++count_;
    const std::uint32_t i = free_;
    free_ = link(records_[i]) & ~dead_bit;
    link(records_[i]) = 0;
    if constexpr (std::is_trivially_destructible_v<Data>) { reset(i); }
    return i;
  }
  // Data that own something let it go here, the others are overwritten when the slot is used again.
  void release(std::uint32_t i) {
    assert(alive(i) && i % Group == 0);
    if constexpr (!std::is_trivially_destructible_v<Data>) { reset(i); }
    link(records_[i]) = dead_bit | free_;
    free_ = i;
    --count_;
  }
  // Appends fresh slots, whatever dead ones there are, and returns the index of the first record; the caller writes the records.
  std::uint32_t append(std::uint32_t slots) {
    assert(records_.size() < end_of_list - slots * Group);
    count_ += slots;
    if constexpr (!std::is_empty_v<Data>) {
      for (std::uint32_t k = 0; k < slots * Group; ++k) { data_.push_back(); }
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
  [[nodiscard]] Allocator allocator() const { return records_.allocator(); }

 private:
  [[gnu::noinline]] std::uint32_t first_use() {  // apart, to keep the operators small
    const std::uint32_t i = append(1);
    for (std::uint32_t k = 0; k < Group; ++k) { records_[i + k] = Record{}; }
    link(records_[i]) = 0;
    return i;
  }
  void reset(std::uint32_t i) {
    if constexpr (!std::is_empty_v<Data>) {
      for (std::uint32_t k = 0; k < Group; ++k) { data_[i + k] = Data{}; }
    }
  }

  std::uint32_t free_ = end_of_list;
  Array<Record, Allocator> records_;
  std::uint32_t count_ = 0;  // not beside free_: the compiler would join the two stores, and the next load of free_ wait for both
  [[no_unique_address]] std::conditional_t<std::is_empty_v<Data>, NoPages<Data, Allocator>, Pages<Data, page_shift + Group - 1, Allocator>>
      data_;
};

}  // namespace brep
