// SPDX-License-Identifier: MIT
#include <brep/csg/plane.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <brep/csg/wide.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg {

namespace detail {

HALFLIGHT_INLINE Int128 gcd(Int128 x, Int128 y) {
  x = size(x), y = size(y);
  while (y != 0) {
    if (x <= INT64_MAX && y <= INT64_MAX) {
      std::uint64_t u = static_cast<std::uint64_t>(x), w = static_cast<std::uint64_t>(y);
      while (w != 0) {
        const std::uint64_t rest = u % w;
        u = w, w = rest;
      }
      return static_cast<Int128>(u);
    }
    const Int128 rest = x % y;
    x = y, y = rest;
  }
  return x;
}

}  // namespace detail

HALFLIGHT_INLINE OrientedPlane PlaneTable::insert(std::array<std::int64_t, 3> n, Int128 d) {
  const Int128 divisor = detail::gcd(detail::gcd(n[0], n[1]), detail::gcd(n[2], d));
  const bool flip = n[0] != 0 ? n[0] < 0 : n[1] != 0 ? n[1] < 0 : n[2] < 0;
  Plane plane;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t reduced = static_cast<std::int64_t>(n[i] / divisor);
    plane.n[i] = flip ? -reduced : reduced;
    plane.normal[i] = static_cast<double>(plane.n[i]);
  }
  plane.d = flip ? -(d / divisor) : d / divisor;
  plane.offset = static_cast<double>(plane.d);
  plane.bound = (std::abs(plane.normal[0]) + std::abs(plane.normal[1]) + std::abs(plane.normal[2])) * 0x1p-24;
  if (2 * planes_.size() >= slots_.size()) { grow(); }
  std::uint32_t& slot = find(plane);
  if (slot == invalid_index) {
    slot = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back(plane);
  }
  return {2 * slot + (flip ? 1u : 0u)};
}

HALFLIGHT_INLINE std::uint64_t PlaneTable::hash(const Plane& p) {
  std::uint64_t h = static_cast<std::uint64_t>(p.d) * 0x9e3779b97f4a7c15u;
  for (std::int64_t x : p.n) { h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u; }
  return h ^ (h >> 32);
}

HALFLIGHT_INLINE std::uint32_t& PlaneTable::find(const Plane& plane) {
  std::size_t i = hash(plane) & (slots_.size() - 1);
  while (slots_[i] != invalid_index && !(planes_[slots_[i]] == plane)) { i = (i + 1) & (slots_.size() - 1); }
  return slots_[i];
}

}  // namespace brep::csg
