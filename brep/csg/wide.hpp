// SPDX-License-Identifier: MIT
#pragma once

// Signed integers of a fixed number of 64-bit words, for the exact predicates.
//
// Two's complement; all arithmetic is modulo 2^(64 N), so a result is right whenever it fits: each use states its bits. Words are unsigned:
// no signed overflow anywhere. There is no division; what is needed of it, predicates.hpp does by multiplication.

#include <array>
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
    for (std::size_t i = 2; i < N; ++i) { words_[i] = value < 0 ? ~std::uint64_t{0} : 0; }
  }
  template <std::size_t M>
  requires(M < N) constexpr explicit Wide(const Wide<M>& value) {
    for (std::size_t i = 0; i < N; ++i) { words_[i] = i < M ? value.word(i) : value.negative() ? ~std::uint64_t{0} : 0; }
  }

  [[nodiscard]] constexpr std::uint64_t word(std::size_t i) const { return words_[i]; }
  [[nodiscard]] constexpr bool negative() const { return (words_[N - 1] >> 63) != 0; }
  [[nodiscard]] constexpr bool zero() const {
    std::uint64_t any = 0;
    for (std::uint64_t w : words_) { any |= w; }
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
      if (a.words_[i] == 0) { continue; }
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

  // As a double, with a relative error below 2^-50.
  [[nodiscard]] double approximate() const {
    const Wide size = negative() ? -*this : *this;
    double value = 0.0;
    for (std::size_t i = N; i-- > 0;) { value = value * 0x1p64 + static_cast<double>(size.words_[i]); }
    return negative() ? -value : value;
  }

 private:
  friend constexpr Wide<4> product(Int128 a, Int128 b);

  std::array<std::uint64_t, N> words_{};
};

// The product of two integers of 128 bits. Unsigned it is short by 2^128 b for a negative a, and by 2^128 a for a negative b.
[[nodiscard]] constexpr Wide<4> product(Int128 a, Int128 b) {
  constexpr auto low = [](Word128 x) { return static_cast<std::uint64_t>(x); };
  const auto x = static_cast<Word128>(a), y = static_cast<Word128>(b);
  const Word128 ll = static_cast<Word128>(low(x)) * low(y), lh = static_cast<Word128>(low(x)) * low(y >> 64);
  const Word128 hl = static_cast<Word128>(low(x >> 64)) * low(y), hh = static_cast<Word128>(low(x >> 64)) * low(y >> 64);
  const Word128 middle = (ll >> 64) + low(lh) + low(hl);
  const Word128 high = hh + (lh >> 64) + (hl >> 64) + (middle >> 64) - (a < 0 ? y : 0) - (b < 0 ? x : 0);
  Wide<4> result;
  result.words_ = {low(ll), low(middle), low(high), low(high >> 64)};
  return result;
}

}  // namespace brep::csg
