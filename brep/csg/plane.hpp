// SPDX-License-Identifier: MIT
#pragma once

// Integer planes a x + b y + c z + d = 0, each kept once: equal planes have equal numbers, so coplanar is a comparison of numbers.
//
// Canonical: gcd(a, b, c, d) = 1 and the first of a, b, c that is not zero is positive. Bits, with |coordinates| < 2^25: a normal from
// three points of the grid has |a|, |b|, |c| <= 2^53 and with it |d| < 2^80. An operation never makes a plane, therefore depth costs no
// bits.
//
// A face names its plane together with the side to which it looks: `Side of a plane` = number * 2 + (1 when the face looks against the
// canonical normal).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/csg/wide.hpp>
#include <brep/handles.hpp>

#ifdef __FAST_MATH__
#error "the filter of brep/csg needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace brep::csg {

struct Plane {
  std::array<std::int64_t, 3> n{};  // |n| <= 2^53
  Int128 d = 0;                     // |d| < 2^80
  std::array<double, 3> normal{};   // n itself: doubles hold 2^53
  double offset = 0.0;              // d, rounded
  double bound = 0.0;               // the filter's: see predicates.hpp

  friend bool operator==(const Plane& p, const Plane& q) { return p.n == q.n && p.d == q.d; }
};

using PlaneNumber = std::uint32_t;

struct OrientedPlane {
  std::uint32_t code = invalid_index;

  [[nodiscard]] PlaneNumber number() const { return code >> 1; }
  [[nodiscard]] int sign() const { return (code & 1) != 0 ? -1 : 1; }  // of the face's normal against the canonical one
  [[nodiscard]] OrientedPlane flipped() const { return {code ^ 1}; }
  friend bool operator==(OrientedPlane, OrientedPlane) = default;
};

namespace detail {

inline Int128 size(Int128 x) { return x < 0 ? -x : x; }
Int128 gcd(Int128 x, Int128 y);

}  // namespace detail

class PlaneTable {
 public:
  [[nodiscard]] const Plane& operator[](PlaneNumber p) const { return planes_[p]; }

  // The plane with this normal, not zero, and offset, looking where the normal points.
  OrientedPlane insert(std::array<std::int64_t, 3> n, Int128 d);

 private:
  static std::uint64_t hash(const Plane& p);
  // The slot of the plane, or the free one where it belongs.
  std::uint32_t& find(const Plane& plane);
  void grow() {
    slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), invalid_index);
    for (std::uint32_t p = 0; p < planes_.size(); ++p) { find(planes_[p]) = p; }
  }

  std::vector<Plane> planes_;
  std::vector<std::uint32_t> slots_;  // open addressing, a power of two
};

}  // namespace brep::csg

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/plane.cpp>
#endif
