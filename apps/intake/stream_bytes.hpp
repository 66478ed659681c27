// SPDX-License-Identifier: MIT
#pragma once

// The bytes of compressed numbers, read from front to back. A read beyond the end, and anything else that cannot be right, leaves the
// decoder by an exception, which its entry (draco::read_mesh, unpack_meshopt) turns into a sentence: the formats are nested too deeply to
// hand every failure from call to call.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "apps/bytes.hpp"

namespace apps::intake {

struct StreamFault {
  std::string sentence;
  std::size_t offset;  // of the byte at which the decoder stood
};

class StreamBytes {
 public:
  explicit StreamBytes(std::string_view bytes, std::size_t offset = 0) : bytes_(bytes), offset_(offset) {}

  [[noreturn]] void refuse(std::string sentence) const { throw StreamFault{std::move(sentence), offset_ + at_}; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  [[nodiscard]] std::string_view take(std::uint64_t size) {
    if (size > left()) { refuse("the stream ends too early"); }
    at_ += static_cast<std::size_t>(size);
    return bytes_.substr(at_ - static_cast<std::size_t>(size), static_cast<std::size_t>(size));
  }
  // The next bytes, as a stream of their own.
  [[nodiscard]] StreamBytes part(std::uint64_t size) {
    const std::size_t begin = offset_ + at_;
    return StreamBytes(take(size), begin);
  }

  [[nodiscard]] std::uint32_t byte() { return static_cast<unsigned char>(take(1)[0]); }
  [[nodiscard]] std::uint32_t number(std::size_t size) { return static_cast<std::uint32_t>(bits_at(take(size), 0, size)); }
  [[nodiscard]] std::int32_t int32() { return static_cast<std::int32_t>(number(4)); }
  [[nodiscard]] float float32() { return std::bit_cast<float>(number(4)); }

  // LEB128 (specification, Core Functions): seven bits a byte, the lowest first.
  [[nodiscard]] std::uint32_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint64_t next = byte();
      value |= (next & 127U) << shift;
      if (next < 128) { break; }
    }
    if (value > 0xffffffffU) { refuse("a number has more than 32 bits"); }
    return static_cast<std::uint32_t>(value);
  }

  // The next bits, the lowest of each byte first; at most 32. After the last one of a row, end_bits() passes to the next whole byte.
  [[nodiscard]] std::uint32_t bits(unsigned count) {
    std::uint64_t value = 0;
    for (unsigned have = 0; have < count;) {
      if (bits_left_ == 0) {
        rest_ = byte();
        bits_left_ = 8;
      }
      const unsigned some = std::min(bits_left_, count - have);
      value |= std::uint64_t{rest_ & ((1U << some) - 1U)} << have;
      rest_ >>= some;
      bits_left_ -= some;
      have += some;
    }
    return static_cast<std::uint32_t>(value);
  }
  void end_bits() { bits_left_ = 0; }

 private:
  std::string_view bytes_;
  std::size_t offset_, at_ = 0;
  std::uint32_t rest_ = 0;  // of the byte whose bits are being read
  unsigned bits_left_ = 0;
};

}  // namespace apps::intake
