// SPDX-License-Identifier: MIT
#include <radiosity/geometry/direction_lattice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE Aim aim(const glm::dvec3& v) {
  int major = std::abs(v.x) >= std::abs(v.y) ? 0 : 1;
  if (std::abs(v.z) > std::abs(v[major])) { major = 2; }
  const int first = major == 0 ? 1 : 0;
  const int second = major == 2 ? 1 : 2;
  const double half = 0.5 * std::abs(v[major]);
  Aim result;
  if (!(half > 0.0)) { return result; }
  const auto cell = [&](double coordinate, double& fraction) {
    const double at = coordinate / half + 2.0;
    const int low = std::clamp(static_cast<int>(at), 0, 3);
    fraction = std::clamp(at - low, 0.0, 1.0);
    return low;
  };
  double f = 0.0;
  double g = 0.0;
  std::array<int, 3> corner{};
  corner[static_cast<std::size_t>(major)] = v[major] > 0.0 ? 4 : 0;
  const int a = cell(v[first], f);
  const int b = cell(v[second], g);
  const auto point = [&](int da, int db) {
    corner[static_cast<std::size_t>(first)] = a + da;
    corner[static_cast<std::size_t>(second)] = b + db;
    return std::uint32_t{detail::direction_lattice.index[static_cast<std::size_t>(25 * corner[0] + 5 * corner[1] + corner[2])]};
  };
  const bool lower = f >= g;
  result.direction = {point(0, 0), lower ? point(1, 0) : point(0, 1), point(1, 1)};
  result.weight = {half * (1.0 - std::max(f, g)), half * std::abs(f - g), half * std::min(f, g)};
  return result;
}

HALFLIGHT_INLINE double shown(const glm::dvec3& normal, const Aim& towards) {
  double sum = 0.0;
  for (std::size_t j = 0; j < 3; ++j) { sum += towards.weight[j] * shown(normal, towards.direction[j]); }
  return sum;
}

HALFLIGHT_INLINE double dot_shown(const glm::dvec3& normal, const double* bins) {
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t k = 0; k < direction_count; k += 2) {
    even += bins[k] * shown(normal, k);
    odd += bins[k + 1] * shown(normal, k + 1);
  }
  return even + odd;
}

}  // namespace radiosity
