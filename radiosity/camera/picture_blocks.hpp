// SPDX-License-Identifier: MIT
#pragma once

// Divides a picture into square blocks of pixels, over which the stages of a gathered picture run in parallel, and counts the memory that
// these take.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

class PictureBlocks {
 public:
  // `control` must outlive it. `memory`: bytes that all stages may take together. Reports the stage "picture".
  PictureBlocks(const PictureSize& size, unsigned threads, const Control& control,
                std::uint64_t memory = std::numeric_limits<std::uint64_t>::max())
      : size_{size},
        columns_{(size.width + block_side - 1) / block_side},
        threads_{thread_count(threads)},
        control_{control},
        memory_{memory} {}

  [[nodiscard]] std::size_t count() const { return columns_ * ((size_.height + std::size_t{block_side} - 1) / block_side); }
  [[nodiscard]] std::size_t pixel(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * size_.width + x; }
  [[nodiscard]] std::size_t block(std::uint32_t x, std::uint32_t y) const { return y / block_side * columns_ + x / block_side; }
  [[nodiscard]] unsigned threads() const { return threads_; }
  [[nodiscard]] const Control& control() const { return control_; }
  // Counts memory that is going to be taken until the picture is done. It is not given back, so whether the count exceeds what is allowed
  // does not depend on which thread counts first.
  void take(std::uint64_t bytes) const { taken_.fetch_add(bytes, std::memory_order_relaxed); }
  [[nodiscard]] bool too_much() const { return taken_.load(std::memory_order_relaxed) > memory_; }

  // Calls body(block) for each block; reports progress between `from` and `to`. False when cancelled or when too much memory is taken,
  // after which a body may return before its block is done: one block can take long where many lamps shine.
  template <class Body>
  [[nodiscard]] bool each_block(double from, double to, const Body& body) const {
    const auto report = [&](std::size_t done) {
      control_.report("picture", from + (to - from) * static_cast<double>(done) / static_cast<double>(count()));
    };
    const auto within_memory = [&](std::size_t block) {
      if (!too_much()) { body(block); }
    };
    return parallel_in_batches(control_, threads_, count(), {512, 4}, within_memory, report) && !control_.cancelled() && !too_much();
  }
  // Calls body(x, y) for each pixel of a block, by rows.
  template <class Body>
  void each_pixel(std::size_t block, const Body& body) const {
    const auto x0 = static_cast<std::uint32_t>(block % columns_) * block_side,
               y0 = static_cast<std::uint32_t>(block / columns_) * block_side;
    for (std::uint32_t y = y0; y < std::min(y0 + block_side, size_.height); ++y) {
      for (std::uint32_t x = x0; x < std::min(x0 + block_side, size_.width); ++x) { body(x, y); }
    }
  }
  // Calls body(x, y) for the pixel and its up to eight neighbours.
  template <class Body>
  void each_neighbour(std::uint32_t x, std::uint32_t y, const Body& body) const {
    for (std::uint32_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, size_.height); ++v) {
      for (std::uint32_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, size_.width); ++u) { body(u, v); }
    }
  }
  // Calls body(block) for the blocks that reach within `pixels` of the pixel, along rows and columns.
  template <class Body>
  void each_block_within(std::uint32_t x, std::uint32_t y, double pixels, const Body& body) const {
    const auto reach = static_cast<std::uint32_t>(std::min(std::ceil(pixels), 1e6));
    const auto low = [&](std::uint32_t at) { return (at > reach ? at - reach : 0) / block_side; };
    const std::uint32_t right = std::min(x + reach, size_.width - 1) / block_side,
                        bottom = std::min(y + reach, size_.height - 1) / block_side;
    for (std::uint32_t v = low(y); v <= bottom; ++v) {
      for (std::uint32_t u = low(x); u <= right; ++u) { body(v * columns_ + u); }
    }
  }

 private:
  PictureSize size_;
  std::size_t columns_;
  unsigned threads_;
  const Control& control_;
  std::uint64_t memory_;
  mutable std::atomic<std::uint64_t> taken_ = 0;
};

}  // namespace radiosity
