// SPDX-License-Identifier: MIT
#pragma once

// The integral of ln r over two straight edges; the contour integral of two polygons (exchange.hpp) is a sum of such integrals. Edges may
// touch, cross or overlap, and make any angle phi. There are three methods; l is the shorter length, h the distance of a point of the
// shorter edge from the line through the other one:
//
//   far            six-point Gauss rule over the shorter edge, applied to the exact potential of the other one.
//   sin phi < .02  closed form for parallel edges, plus the effect of the angle. A change of h changes the potential of each half of the
//                  other edge by at most pi/2 times as much, so the effect is below pi/2 sin(phi) l^2. For edges that are parallel up to
//                  rounding the closed form alone suffices; otherwise the change is integrated numerically.
//   else           Euler's theorem on homogeneous functions. With s and t measured from the common perpendicular of the lines, d its
//                  length, r^2 = s^2 + t^2 - 2 s t cos phi + d^2 and (s d/ds + t d/dt) ln r = 1 - d^2 / r^2; by Gauss's theorem
//                    2 I = [s int ln r dt] + [t int ln r ds] - a b + d^2 int int ds dt / r^2.
//                  The last integral is, over one edge, of an angle over h; with s = d / sin(phi) sinh(u), h = d cosh(u), it is that of
//                  the angle over u. For edges in one plane (d = 0) it vanishes.
//
// The integrands are analytic except at known points outside the interval, where r or h is 0. So the error of the Gauss rule on an
// interval is known beforehand, and intervals are halved until it is small enough. No values are compared, so rounding noise cannot keep
// the bisection going.
//
// Lengths and coordinates must be at most 1. Error: at most the tolerance plus 1e-13 of rounding.

#include <glm/vec3.hpp>

namespace radiosity::detail {

struct Edge {
  glm::dvec3 start{0.0};
  glm::dvec3 direction{0.0};  // unit length
  double length = 0.0;
};

// Upper bound of the evaluations of potentials and angles for one pair of edges: three singular points, near each of which intervals are
// halved some twenty times.
inline constexpr int most_asked = 500;

// Integral of ln r over both edges; adds the number of evaluations to `asked`.
[[nodiscard]] double edge_pair(const Edge& a, const Edge& b, double tolerance, int& asked);

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/edge_pair.cpp>
#endif
