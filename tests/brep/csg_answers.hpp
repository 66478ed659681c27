// SPDX-License-Identifier: MIT
#pragma once

// How the tests of CSG compare results with known answers: Euler characteristic, shells and volume, both ways round, with the identities
//   vol(u) + vol(i) = vol(A) + vol(B),   vol(A - B) + vol(i) = vol(A),   A - B = A n ~B,   (A u B) - B = A - B
// and the areas of regular sets: area(u) + area(i) = area(A) + area(B) - 2 area of what faces each other.

#include "catch.hpp"
#include "csg_solids.hpp"

namespace solids {

using namespace brep;

inline constexpr double eps = 1e-12;  // volumes are of order 1 with coordinates of 2^-53, of which some hundred are multiplied and added

inline const Grid& grid() {
  static const Grid g(glm::dvec3(-8.0), glm::dvec3(8.0));
  return g;
}
inline Solid made(const Builder& b, const Grid& g = grid()) {
  const auto result = leaf(b, g);
  INFO(result.refusal().sentence());
  REQUIRE(result);
  return *result;
}
inline Solid valid(const Result<Solid>& result) {
  INFO(result.refusal().sentence());
  REQUIRE(result);
  CHECK(faults(*result) == "");
  return *result;
}
inline Solid cube() { return made(box(glm::dvec3(0.0), glm::dvec3(1.0))); }

struct All {
  Solid u, i, d, r;
};
inline All all(const Solid& a, const Solid& b, double facing = -1.0) {
  All x{valid(csg::unite(a, b)), valid(csg::intersect(a, b)), valid(csg::subtract(a, b)), valid(csg::subtract(b, a))};
  const auto u = valid(csg::unite(b, a)), i = valid(csg::intersect(b, a));
  const double va = csg::volume(a), vb = csg::volume(b), scale = va + vb;
  CHECK(csg::volume(x.u) + csg::volume(x.i) == test::Approx(va + vb).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(x.d) + csg::volume(x.i) == test::Approx(va).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(x.r) + csg::volume(x.i) == test::Approx(vb).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(u) == test::Approx(csg::volume(x.u)).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(i) == test::Approx(csg::volume(x.i)).epsilon(0).margin(eps * scale));
  CHECK(counts(u).chi() == counts(x.u).chi());
  CHECK(counts(i).chi() == counts(x.i).chi());
  const auto again = valid(csg::subtract(x.u, b));
  CHECK(csg::volume(again) == test::Approx(csg::volume(x.d)).epsilon(0).margin(eps * scale));
  // A - B = A n ~B, the complement of B within the box that holds the whole grid.
  const glm::dvec3 reach(a.grid().spacing() * (0x1p25 - 2.0));
  const Solid everything = made(box(a.grid().centre() - reach, a.grid().centre() + reach), a.grid());
  const auto complement = csg::subtract(everything, b);
  REQUIRE(complement);
  const auto without = csg::intersect(a, *complement);
  REQUIRE(without);
  CHECK(csg::volume(*without) == test::Approx(csg::volume(x.d)).epsilon(0).margin(eps * scale));
  CHECK(counts(*without) == counts(x.d));
  CHECK(valid(csg::subtract(x.d, x.d)).empty());
  CHECK(valid(csg::subtract(csg::subtract(x.u, a).has_value() ? *csg::subtract(x.u, a) : x.u, b)).empty());
  if (facing >= 0.0) {
    CHECK(csg::area(x.u) + csg::area(x.i) ==
          test::Approx(csg::area(a) + csg::area(b) - 2.0 * facing).epsilon(0).margin(eps * (csg::area(a) + csg::area(b))));
  }
  return x;
}
struct Expected {
  long chi;
  std::size_t shells;
  double volume;
};
inline void check(const Solid& solid, const Expected& e, double tolerance = eps) {
  const Counts c = counts(solid);
  CHECK(c.chi() == e.chi);
  CHECK(c.shells == e.shells);
  CHECK(c.volume == test::Approx(e.volume).epsilon(0).margin(tolerance * std::max(1.0, std::abs(e.volume))));
}

}  // namespace solids
