// SPDX-License-Identifier: MIT
#pragma once

// Low-discrepancy points in the unit cube of four dimensions: Sobol's sequence (Sobol 1967; direction numbers of Joe and Kuo 2008),
// scrambled by random digits (Owen 1995). Each scramble gives an unbiased estimate of an integral, so the spread of several scrambles
// gives the standard error of their mean; the error of each decreases almost like 1 / n instead of 1 / sqrt(n).
//
// The scramble is a hash in which each bit depends only on the higher ones (Laine and Karras 2011, constants of Burley 2020).

#include <array>
#include <cstddef>
#include <cstdint>

#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
  x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
  return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

[[nodiscard]] constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t key) {
  x = reverse_bits(x);
  x ^= x * 0x3d20adeau;
  x += key;
  x *= (key >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

// Direction numbers for each bit of the index: dimension 0 is the radical inverse; the others belong to the polynomials
// x + 1, x^2 + x + 1 and x^3 + x + 1.
[[nodiscard]] constexpr std::array<std::array<std::uint32_t, 4>, 32> sobol_directions() {
  constexpr std::uint32_t degree[4] = {0, 1, 2, 3};
  constexpr std::uint32_t inner[4] = {0, 0, 1, 1};  // coefficients between the first and the last one
  constexpr std::uint32_t first[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {1, 3, 1}};
  std::array<std::array<std::uint32_t, 4>, 32> v{};
  for (std::uint32_t k = 0; k < 32; ++k) { v[k][0] = 0x80000000u >> k; }
  for (std::size_t d = 1; d < 4; ++d) {
    const std::uint32_t s = degree[d];
    for (std::uint32_t k = 0; k < 32; ++k) {
      if (k < s) {
        v[k][d] = first[d][k] << (31 - k);
        continue;
      }
      v[k][d] = v[k - s][d] ^ (v[k - s][d] >> s);
      for (std::uint32_t j = 1; j < s; ++j) {
        if ((inner[d] >> (s - 1 - j)) & 1u) { v[k][d] ^= v[k - j][d]; }
      }
    }
  }
  return v;
}
inline constexpr std::array<std::array<std::uint32_t, 4>, 32> sobol_direction = sobol_directions();

}  // namespace detail

// One scrambled sequence. The key chooses the scramble; points are a pure function of key and index.
class Sobol4 {
 public:
  explicit constexpr Sobol4(std::uint64_t seed, std::uint64_t key = 0) {
    Random random{seed, key, 0x736f626f6cull};
    for (std::uint32_t& k : keys_) { k = static_cast<std::uint32_t>(random.bits() >> 32); }
  }

  // Point `index`, each coordinate in (0, 1).
  [[nodiscard]] constexpr std::array<double, 4> operator()(std::uint32_t index) const { return coordinates<4>(index); }
  // Its first two coordinates.
  [[nodiscard]] constexpr std::array<double, 2> first_two(std::uint32_t index) const { return coordinates<2>(index); }

 private:
  template <std::size_t N>
  [[nodiscard]] constexpr std::array<double, N> coordinates(std::uint32_t index) const {
    std::array<std::uint32_t, N> x{};
    for (std::size_t k = 0; index != 0; ++k, index >>= 1) {
      const std::uint32_t mask = 0u - (index & 1u);
      for (std::size_t d = 0; d < N; ++d) { x[d] ^= detail::sobol_direction[k][d] & mask; }
    }
    std::array<double, N> point{};
    for (std::size_t d = 0; d < N; ++d) { point[d] = (detail::owen_scramble(x[d], keys_[d]) + 0.5) * 0x1p-32; }
    return point;
  }

  std::array<std::uint32_t, 4> keys_{};
};

// The numbers of path `index` of a family: the first eight, which matter most, are coordinates of two Sobol points; all further ones are
// independent. The second point has a permuted index (Burley 2020), so that both points together are well distributed, too.
class PathNumbers {
 public:
  PathNumbers(const Sobol4& first, const Sobol4& second, std::uint32_t index, Random rest)
      : points_{first(index), second(detail::owen_scramble(index, 0x9e3779b9u))}, rest_{rest} {}

  [[nodiscard]] double uniform() {
    if (used_ == 8) { return rest_.uniform(); }
    const std::size_t k = used_++;
    return points_[k / 4][k % 4];
  }

 private:
  std::array<std::array<double, 4>, 2> points_;
  std::size_t used_ = 0;
  Random rest_;
};

}  // namespace radiosity
