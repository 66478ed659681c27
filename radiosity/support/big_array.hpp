// SPDX-License-Identifier: MIT
#pragma once

// Arrays that grow with the nodes, links, pairs and rays of a run. The caller may choose their memory (Options::arrays). A moved array
// keeps its memory; a copy is on the heap, so that it may outlive the memory of its original.

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <type_traits>
#include <vector>

namespace radiosity {

template <class T>
class ArrayAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  ArrayAllocator() = default;
  ArrayAllocator(std::pmr::memory_resource* memory) : memory_{memory} {}  // implicit, as for std allocators; null: the heap
  template <class U>
  ArrayAllocator(const ArrayAllocator<U>& other) : memory_{other.memory()} {}

  [[nodiscard]] T* allocate(std::size_t count) {
    if (memory_ == nullptr) { return std::allocator<T>().allocate(count); }
    return static_cast<T*>(memory_->allocate(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* block, std::size_t count) {
    if (memory_ == nullptr) { return std::allocator<T>().deallocate(block, count); }
    memory_->deallocate(block, count * sizeof(T), alignof(T));
  }
  [[nodiscard]] ArrayAllocator select_on_container_copy_construction() const { return {}; }
  [[nodiscard]] std::pmr::memory_resource* memory() const { return memory_; }
  friend bool operator==(const ArrayAllocator& a, const ArrayAllocator& b) { return a.memory_ == b.memory_; }

 private:
  std::pmr::memory_resource* memory_ = nullptr;
};

template <class T>
using BigArray = std::vector<T, ArrayAllocator<T>>;

}  // namespace radiosity
