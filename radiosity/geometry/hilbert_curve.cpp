// SPDX-License-Identifier: MIT
#include <radiosity/geometry/hilbert_curve.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::uint64_t along_hilbert_curve(const glm::dvec3& point) {
  constexpr unsigned bits = 16;
  std::array<std::uint32_t, 3> x{};
  for (int k = 0; k < 3; ++k) {
    x[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(std::clamp(point[k], 0.0, 1.0) * ((1u << bits) - 1));
  }
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t lower = q - 1;
    for (std::uint32_t& axis : x) {
      const std::uint32_t t = (x[0] ^ axis) & lower;
      if ((axis & q) != 0) {
        x[0] ^= lower;
      } else {
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) { t ^= (x[2] & q) != 0 ? q - 1 : 0; }
  std::uint64_t place = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 0; q >>= 1) {
    for (const std::uint32_t axis : x) { place = place << 1 | (((axis ^ t) & q) != 0 ? 1u : 0u); }
  }
  return place;
}

}  // namespace radiosity
