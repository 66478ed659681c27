// SPDX-License-Identifier: MIT
#pragma once

// Signed integers of a fixed number of 64-bit words, for the exact predicates.
//
// Two's complement; all arithmetic is modulo 2^(64 N), so a result is right whenever it fits: each use states its bits. Words are unsigned:
// no signed overflow anywhere. There is no division; what is needed of it, predicates.hpp does by multiplication.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace brep::csg {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Word128;

template <std::size_t N>
class Wide {
 public:
  constexpr Wide() = default;
  constexpr Wide(Int128 value) {  // implicit: every smaller integer is one
    words_[0] = static_cast<std::uint64_t>(value);
    words_[1] = static_cast<std::uint64_t>(static_cast<Word128>(value) >> 64);
    for (std::size_t i = 2; i < N; ++i) words_[i] = value < 0 ? ~std::uint64_t{0} : 0;
  }
  template <std::size_t M>
  requires(M < N) constexpr explicit Wide(const Wide<M>& value) {
    for (std::size_t i = 0; i < N; ++i) words_[i] = i < M ? value.word(i) : value.negative() ? ~std::uint64_t{0} : 0;
  }

  [[nodiscard]] constexpr std::uint64_t word(std::size_t i) const { return words_[i]; }
  [[nodiscard]] constexpr bool negative() const { return (words_[N - 1] >> 63) != 0; }
  [[nodiscard]] constexpr bool zero() const {
    std::uint64_t any = 0;
    for (std::uint64_t w : words_) any |= w;
    return any == 0;
  }
  [[nodiscard]] constexpr int sign() const { return negative() ? -1 : zero() ? 0 : 1; }

  friend constexpr Wide operator+(const Wide& a, const Wide& b) {
    Wide sum;
    Word128 carry = 0;
    for (std::size_t i = 0; i < N; ++i) {
      carry += static_cast<Word128>(a.words_[i]) + b.words_[i];
      sum.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend constexpr Wide operator-(const Wide& a) {
    Wide result;
    Word128 carry = 1;
    for (std::size_t i = 0; i < N; ++i) {
      carry += static_cast<std::uint64_t>(~a.words_[i]);
      result.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return result;
  }
  friend constexpr Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  friend constexpr Wide operator*(const Wide& a, const Wide& b) {
    Wide product;
    for (std::size_t i = 0; i < N; ++i) {
      if (a.words_[i] == 0) continue;
      Word128 carry = 0;
      for (std::size_t j = 0; i + j < N; ++j) {
        carry += static_cast<Word128>(a.words_[i]) * b.words_[j] + product.words_[i + j];
        product.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    return product;
  }
  friend constexpr bool operator==(const Wide&, const Wide&) = default;

  // The nearest double but for a relative error of 2^-52.
  [[nodiscard]] double approximate() const {
    const Wide size = negative() ? -*this : *this;
    std::size_t top = N;
    while (top > 1 && size.words_[top - 1] == 0) --top;
    double value = std::ldexp(static_cast<double>(size.words_[top - 1]), static_cast<int>(64 * (top - 1)));
    if (top > 1) value += std::ldexp(static_cast<double>(size.words_[top - 2]), static_cast<int>(64 * (top - 2)));
    return negative() ? -value : value;
  }

 private:
  std::array<std::uint64_t, N> words_{};
};

}  // namespace brep::csg
