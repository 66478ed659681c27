// SPDX-License-Identifier: MIT
#pragma once

// The integral of ln r over two straight edges, of which the contour integral of two polygons is made (exchange.hpp). Edges may touch,
// cross or overlap, and make any angle phi. Three ways; l is the shorter length, h the distance of a point of the shorter edge from the
// line of the other one:
//
//   far            the six-point Gauss rule over the shorter edge, of the exact potential of the other one.
//   sin phi < .02  the closed form of parallel edges, and what the angle changes. A change of h changes the potential of each half of the
//                  other edge by at most pi/2 times as much, so all of it is below pi/2 sin(phi) l^2. Edges that are parallel except for
//                  rounded coordinates need the closed form alone; else the change is integrated.
//   else           Euler's theorem on homogeneous functions. With s and t measured from the common perpendicular of the lines, d its
//                  length, r^2 = s^2 + t^2 - 2 s t cos phi + d^2 and (s d/ds + t d/dt) ln r = 1 - d^2 / r^2; by Gauss's theorem
//                    2 I = [s int ln r dt] + [t int ln r ds] - a b + d^2 int int ds dt / r^2.
//                  The last integral is, over one edge, of an angle over h; with s = d / sin(phi) sinh(u), h = d cosh(u), it is that of
//                  the angle over u. For edges in one plane nothing of it remains.
//
// What is integrated is analytic except for points beside the interval at which r or h is 0, and these are known. So it is known beforehand
// which intervals are short enough for the Gauss rule; nothing is compared, and no noise can keep the bisection going.
//
// Lengths and coordinates are at most 1. Error: at most the tolerance, and 1e-13 of rounding.

#include <glm/vec3.hpp>

namespace radiosity::detail {

struct Edge {
  glm::dvec3 start{0.0};
  glm::dvec3 direction{0.0};  // unit length
  double length = 0.0;
};

// Values of potentials and angles that one pair of edges may cost: at three points next to which intervals are halved some twenty times.
inline constexpr int most_asked = 500;

// Integral of ln r over both edges; `asked` counts.
[[nodiscard]] double edge_pair(const Edge& a, const Edge& b, double tolerance, int& asked);

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/edge_pair.cpp>
#endif
