// SPDX-License-Identifier: MIT
#pragma once

// One of every curved or solid primitive, of unit size about the origin, with an oracle in long double that shares no code with it: the
// implicit function, negative inside. Away from cusps |implicit| is within a factor `steepness` of the distance from the surface.

#include "support.hpp"

#include <raycast/objects/cone.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/instance.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <array>
#include <functional>
#include <string>

namespace test {

using Real = long double;
using Point = std::array<Real, 3>;

struct Primitive {
  std::string name;
  std::function<raycast::Made<raycast::Object>(const dvec3& centre, double size)> make;
  std::function<Real(const Point&)> implicit;
  double steepness = 1.0;
  bool creased = false;                       // its one sheet has edges
  bool pinched = false;                       // has blades or needles
  std::function<Real(const Point&)> blade{};  // if pinched: distance from the nearest plane or curve in which they lie
};

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator*(Real s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Point real(const dvec3& p) { return {p.x, p.y, p.z}; }

// The solid of |A - ring|^q + |z|^q <= 1, A^p = |x|^p + |y|^p.
inline Primitive superquadric(const std::string& name, dvec3 radii, double profile, double around, double ring = 0.0) {
  const auto gauge = [](Real x, Real y, double exponent) {
    const Real p = 2 / static_cast<Real>(exponent), large = std::max(std::abs(x), std::abs(y)), small = std::min(std::abs(x), std::abs(y));
    return large > 0 ? large * std::pow(1 + std::pow(small / large, p), 1 / p) : 0;
  };
  const Real thinnest = std::min({radii.x, radii.y, radii.z});
  const auto from_ring = [=](const Point& p) { return gauge(p[0] / radii.x, p[1] / radii.y, around) - ring; };
  return {name,
          [=](const dvec3& centre, double size) { return raycast::Superquadric::make(centre, size * radii, profile, around, ring); },
          [=](const Point& p) { return (gauge(from_ring(p), p[2] / radii.z, profile) - 1) * thinnest; },
          2 * std::max({radii.x, radii.y, radii.z}) / std::min({radii.x, radii.y, radii.z}) * (1 + ring),
          profile >= 2 || around >= 2,
          profile > 2 || around > 2,
          [=](const Point& p) {
            return std::min({std::abs(p[0]), std::abs(p[1]), std::abs(p[2]), std::abs(from_ring(p)) * thinnest});
          }};
}

inline std::vector<Primitive> primitives() {
  using namespace raycast;
  const auto across = [](const Point& p) { return std::hypot(p[0], p[1]); };
  const auto cone = [across](Real base, Real top) {  // z from 0 to 1
    return [=](const Point& p) {
      const Real slope = top - base;
      return std::max({-p[2], p[2] - 1, (across(p) - (base + slope * p[2])) / std::sqrt(1 + slope * slope)});
    };
  };
  const dvec3 z{0, 0, 1};
  return {
      {"sphere", [](const dvec3& c, double s) { return Sphere::make(c, s); },
       [](const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1; }},
      {"box", [](const dvec3& c, double s) { return BoxObject::make(c - s * dvec3(1, 0.5, 0.25), c + s * dvec3(1, 0.5, 0.25)); },
       [](const Point& p) {
         return std::max({std::abs(p[0]) - 1, std::abs(p[1]) - static_cast<Real>(0.5), std::abs(p[2]) - static_cast<Real>(0.25)});
       }},
      {"cylinder", [=](const dvec3& c, double s) { return Cylinder::make(c, s * z, s); }, cone(1, 1)},
      {"cone", [=](const dvec3& c, double s) { return Cone::make(c, s * z, 0.75 * s); }, cone(0.75L, 0)},
      {"frustum", [=](const dvec3& c, double s) { return Cone::make(c, s * z, 0.5 * s, 0.25 * s); }, cone(0.5L, 0.25L)},
      {"cup", [=](const dvec3& c, double s) { return Cone::make(c, s * z, 0.25 * s, s); }, cone(0.25L, 1)},
      {"torus", [=](const dvec3& c, double s) { return Torus::make(c, z, 0.75 * s, 0.25 * s); },
       [across](const Point& p) { return std::hypot(across(p) - 0.75L, p[2]) - 0.25L; }},
      {"thin torus", [=](const dvec3& c, double s) { return Torus::make(c, z, s, 0x1p-8 * s); },
       [across](const Point& p) { return std::hypot(across(p) - 1, p[2]) - 0x1p-8L; }},
      {"thick torus", [=](const dvec3& c, double s) { return Torus::make(c, z, 0.5 * s, 0.46875 * s); },
       [across](const Point& p) { return std::hypot(across(p) - 0.5L, p[2]) - 0.46875L; }},
      superquadric("ellipsoid", {1, 0.5, 0.25}, 1, 1),
      superquadric("rounded box", {1, 0.75, 0.5}, 0.2, 0.3),
      superquadric("sharp box", {1, 1, 1}, 0.01, 0.01),
      superquadric("octahedron", {1, 1, 1}, 2, 2),
      superquadric("pillow", {1, 1, 0.5}, 1.5, 0.25),
      superquadric("double cone", {0.5, 0.5, 1}, 2, 1),
      superquadric("star", {1, 1, 1}, 3, 3),
      superquadric("cross", {1, 1, 1}, 0.5, 4),
      superquadric("spinning top", {1, 1, 1}, 3, 1),
      superquadric("pinched drum", {1, 1, 0.5}, 0.1, 2.5),
      superquadric("needles", {1, 1, 1}, 6, 8),
      superquadric("supertorus", {0.25, 0.25, 0.25}, 1, 1, 3),
      superquadric("square ring", {0.25, 0.25, 0.25}, 0.2, 0.3, 2),
      superquadric("diamond ring", {0.25, 0.25, 0.5}, 2, 1.5, 3),
      superquadric("star ring", {0.25, 0.25, 0.5}, 3, 3, 2),
  };
}

// The line in the primitive's unit coordinates, exactly.
inline Point point_at(const raycast::Segment& line, Real t, const dvec3& centre, double size) {
  Point p{};
  for (int k = 0; k < 3; ++k) {
    p[static_cast<std::size_t>(k)] = (line.origin[k] + t * static_cast<Real>(line.direction[k]) - centre[k]) / size;
  }
  return p;
}

}  // namespace test
