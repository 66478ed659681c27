// SPDX-License-Identifier: MIT
// Which triangle of a plane holds a point.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/picture/plane_grid.hpp>
#include <radiosity/support/random.hpp>

namespace {

using radiosity::PlaneGrid;
using Triangles = std::vector<PlaneGrid::Corners>;

// A plane: where it is, and two directions in it.
struct Plane {
  glm::dvec3 origin{0.0}, s{0.0}, t{0.0};
  [[nodiscard]] glm::dvec3 at(double u, double v) const { return origin + u * s + v * t; }
};

Plane any_plane(radiosity::Random& random) {
  const glm::dvec3 n = radiosity::cosine_direction({0, 0, random.uniform() < 0.5 ? 1 : -1}, random.uniform(), random.uniform());
  const auto [s, t] = radiosity::orthonormal(n);
  const auto coordinate = [&] { return 2.0 * random.uniform() - 1.0; };
  return {{coordinate(), coordinate(), coordinate()}, s, t};
}

// A rectangle in triangles, divided the more the nearer to a point of it: as a mesh is at a contact.
void divide(const Plane& plane, const glm::dvec2& lo, const glm::dvec2& hi, const glm::dvec2& fine, int depth, Triangles& result) {
  const double size = std::max(hi.x - lo.x, hi.y - lo.y);
  const double du = std::max({lo.x - fine.x, fine.x - hi.x, 0.0}), dv = std::max({lo.y - fine.y, fine.y - hi.y, 0.0});
  if (depth > 0 && size > 0.5 * std::max(du, dv)) {
    const glm::dvec2 middle = 0.5 * (lo + hi);
    divide(plane, lo, middle, fine, depth - 1, result);
    divide(plane, {middle.x, lo.y}, {hi.x, middle.y}, fine, depth - 1, result);
    divide(plane, {lo.x, middle.y}, {middle.x, hi.y}, fine, depth - 1, result);
    divide(plane, middle, hi, fine, depth - 1, result);
    return;
  }
  result.push_back({plane.at(lo.x, lo.y), plane.at(hi.x, lo.y), plane.at(hi.x, hi.y)});
  result.push_back({plane.at(lo.x, lo.y), plane.at(hi.x, hi.y), plane.at(lo.x, hi.y)});
}

// A fan around one corner of a polygon with many.
Triangles fan(const Plane& plane, int corners) {
  Triangles result;
  const auto corner = [&](int k) {
    return plane.at(std::cos(2 * std::numbers::pi * k / corners), std::sin(2 * std::numbers::pi * k / corners));
  };
  for (int k = 1; k + 1 < corners; ++k) { result.push_back({corner(0), corner(k), corner(k + 1)}); }
  return result;
}

// The smallest barycentric coordinate of a point of the plane.
double depth_in(const PlaneGrid::Corners& t, const glm::dvec3& p) {
  const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
  double least = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
    least = std::min(least, glm::dot(glm::cross(b - a, p - a), n) / glm::dot(n, n));
  }
  return least;
}

// `all`: no place of the plane has too many triangles for a grid.
void check(const Triangles& triangles, const Plane& plane, radiosity::Random& random, int count, double reach, bool all) {
  const PlaneGrid grid{triangles};
  for (int i = 0; i < count; ++i) {
    // In some triangle, or anywhere.
    glm::dvec3 p = plane.at(reach * (2.0 * random.uniform() - 1.0), reach * (2.0 * random.uniform() - 1.0));
    if (i % 2 == 0) {
      const PlaneGrid::Corners& t = triangles[static_cast<std::size_t>(random.uniform() * static_cast<double>(triangles.size()))];
      const double a = random.uniform(), b = random.uniform() * (1.0 - a);
      p = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
    }
    double deepest = -1.0;
    for (const PlaneGrid::Corners& t : triangles) { deepest = std::max(deepest, depth_in(t, p)); }
    const auto found = grid.find(p);
    if (std::abs(deepest) < 1e-7) { continue; }  // on an edge: either is right
    CAPTURE(i, deepest);
    if (all || found) { REQUIRE(found.has_value() == (deepest > 0.0)); }
    if (!found) { continue; }
    const PlaneGrid::Corners& own = triangles[found->triangle];
    REQUIRE(depth_in(own, p) > -1e-7);
    const glm::dvec3& w = found->weight;
    REQUIRE(glm::length(w.x * own[0] + w.y * own[1] + w.z * own[2] - p) < 1e-9);
  }
}

}  // namespace

TEST_CASE("a point of a plane is found in a triangle that holds it, where there is one") {
  constexpr std::uint64_t seed = 11;
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 20; ++k) {
    const Plane plane = any_plane(random);
    Triangles triangles;
    divide(plane, {-1, -1}, {1, 1}, {2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0}, 3 + k % 12, triangles);
    if (k % 3 == 1) { triangles.resize(triangles.size() / 2); }  // parts that are buried
    if (k % 3 == 2) {
      std::swap(triangles.front(), triangles[triangles.size() / 2]);
      triangles[1] = triangles[2];
    }  // one twice, a hole
    check(triangles, plane, random, 400, 1.2, true);
  }
}

TEST_CASE("a point of a plane is found in no wrong triangle among slivers of a fan, and triangles given many times") {
  constexpr std::uint64_t seed = 12;
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (const int corners : {4, 9, 100, 3000}) {
    const Plane plane = any_plane(random);
    Triangles triangles = fan(plane, corners);
    check(triangles, plane, random, 200, 1.2, corners < 100);
    for (std::size_t k = 0; k < 500; ++k) { triangles.push_back(triangles[k % 3]); }
    check(triangles, plane, random, 200, 1.2, false);
  }
}

TEST_CASE("triangles without an area hold no point of a plane, and no grid over none fails") {
  REQUIRE_FALSE(PlaneGrid{}.find({0, 0, 0}));
  const Triangles flat{{glm::dvec3{0, 0, 0}, glm::dvec3{1, 1, 0}, glm::dvec3{2, 2, 0}},
                       {glm::dvec3{1, 1, 1}, glm::dvec3{1, 1, 1}, glm::dvec3{1, 1, 1}}};
  REQUIRE_FALSE(PlaneGrid{flat}.find({1, 1, 0}));
  const PlaneGrid one{Triangles{{glm::dvec3{0, 0, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}}}};
  REQUIRE(one.find({0.25, 0.25, 0}));
  REQUIRE_FALSE(one.find(glm::dvec3{std::numeric_limits<double>::quiet_NaN()}));
}
