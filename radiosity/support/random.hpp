// SPDX-License-Identifier: MIT
#pragma once

// Random numbers that are a pure function of their purpose: a sample is hashed from the identity of its nodes or its point,
// never drawn from a shared stream, so results do not depend on the order of work.

#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace radiosity {

// A bijective scramble of 64 bits (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
[[nodiscard]] constexpr std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// The stream of numbers for the key (a, b).
class Random {
 public:
  constexpr Random(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) : state_{scramble(scramble(scramble(seed) ^ a) ^ b)} {}

  [[nodiscard]] constexpr std::uint64_t bits() { return scramble(state_++); }

  // Skips `count` numbers, which are drawn elsewhere: their bits() are scramble(s), scramble(s + 1), ... for the returned s.
  [[nodiscard]] constexpr std::uint64_t pass(std::uint64_t count) {
    state_ += count;
    return state_ - count;
  }

  // Uniform in [0, 1), 53 bits.
  [[nodiscard]] constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

// Two unit vectors that make a right-handed orthonormal basis with the unit vector n, without branches (Duff et al. 2017).
struct Tangents {
  glm::dvec3 s{0.0}, t{0.0};
};
[[nodiscard]] inline Tangents orthonormal(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

// A unit direction about the unit normal n, with density cos(theta) / pi; u and v in [0, 1).
[[nodiscard]] inline glm::dvec3 cosine_direction(const glm::dvec3& n, double u, double v) {
  const auto [s, t] = orthonormal(n);
  const double radius = std::sqrt(u);
  const double angle = 2.0 * std::numbers::pi * v;
  return glm::normalize(radius * std::cos(angle) * s + radius * std::sin(angle) * t + std::sqrt(1.0 - u) * n);
}

}  // namespace radiosity
