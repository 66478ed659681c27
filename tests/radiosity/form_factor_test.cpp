// SPDX-License-Identifier: MIT

// Laws of form factors: known values, reciprocity, additivity, closed enclosures, invariance.

#include <cmath>
#include <random>

#include "catch.hpp"

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>

using radiosity::exchange;
using radiosity::make_patch;
using radiosity::Patch;
using radiosity::Polygon;

namespace {

// The rectangle a, a+u, a+u+v, a+v; its bright side is that of cross(u, v).
Polygon rectangle(const glm::dvec3& a, const glm::dvec3& u, const glm::dvec3& v) { return {a, a + u, a + u + v, a + v}; }

const glm::dvec3 X{1.0, 0.0, 0.0};
const glm::dvec3 Y{0.0, 1.0, 0.0};
const glm::dvec3 Z{0.0, 0.0, 1.0};
const glm::dvec3 O{0.0};

double form_factor(const Polygon& p, const Polygon& q) {
  const Patch a = make_patch(p);
  return exchange(a, make_patch(q)) / a.area;
}

// The six walls of the unit cube, seen from inside.
std::vector<Polygon> cube() {
  return {rectangle(O, X, Y), rectangle(Z, Y, X), rectangle(O, Y, Z), rectangle(X, Z, Y), rectangle(O, Z, X), rectangle(Y, X, Z)};
}

}  // namespace

TEST_CASE("two parallel unit squares at distance 1 exchange 0.1998248957 (Howell C-11)") {
  CHECK(std::abs(form_factor(rectangle(O, X, Y), rectangle(Z, Y, X)) - 0.1998248956983873830) < 1e-12);
}

TEST_CASE("two perpendicular unit squares with a common edge exchange 0.2000437761 (Howell C-14)") {
  CHECK(std::abs(form_factor(rectangle(O, X, Y), rectangle(O, Y, Z)) - 0.2000437761) < 1e-10);
}

TEST_CASE("infinite plates: the form factor of close parallel squares tends to 1") {
  // 1 - F of two unit squares at distance h is 4 h / pi (1 + ln(...)), below 10 h for h < 1e-3.
  for (const double h : {1e-3, 1e-5, 1e-7}) {
    const double f = form_factor(rectangle(O, X, Y), rectangle(h * Z, Y, X));
    CHECK(f < 1.0);
    CHECK(1.0 - f < 10.0 * h);
  }
}

TEST_CASE("walls of a cube: each row of form factors sums to 1") {
  const std::vector<Polygon> walls = cube();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < walls.size(); ++j) {
      if (j != i) { sum += form_factor(walls[i], walls[j]); }
    }
    CHECK(std::abs(sum - 1.0) < 1e-12);
  }
}

TEST_CASE("an empty enclosure of random tetrahedra: rows sum to 1 for any shape") {
  std::mt19937_64 engine{20240611};
  INFO("seed 20240611");
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  for (int trial = 0; trial < 20; ++trial) {
    glm::dvec3 v[4];
    for (glm::dvec3& p : v) { p = {uniform(engine), uniform(engine), uniform(engine)}; }
    const double volume = glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), v[3] - v[0]);
    if (std::abs(volume) < 0.1) { continue; }
    if (volume < 0.0) { std::swap(v[0], v[1]); }
    const std::vector<Polygon> faces{{v[0], v[1], v[2]}, {v[0], v[3], v[1]}, {v[1], v[3], v[2]}, {v[2], v[3], v[0]}};
    for (std::size_t i = 0; i < 4; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 4; ++j) { sum += i == j ? 0.0 : form_factor(faces[i], faces[j]); }
      CHECK(std::abs(sum - 1.0) < 1e-7);  // bisection tolerance 1e-9 an edge pair, nine pairs, area ratio up to ten
    }
  }
}

TEST_CASE("reciprocity: the exchange is the same from both sides") {
  std::mt19937_64 engine{7};
  INFO("seed 7");
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  for (int trial = 0; trial < 200; ++trial) {
    const auto random = [&] { return glm::dvec3{uniform(engine), uniform(engine), uniform(engine)}; };
    const Patch p = make_patch({random(), random(), random()});
    const Patch q = make_patch({random(), random(), random()});
    const double there = exchange(p, q);
    const double back = exchange(q, p);
    CHECK(std::abs(there - back) <= 1e-8 * std::min(p.area, q.area));
    CHECK(there <= std::min(p.area, q.area) * (1.0 + 1e-9));
    CHECK(there >= 0.0);
  }
}

TEST_CASE("additivity: a patch exchanges what its four quarters exchange") {
  const Polygon whole = rectangle({0.2, 0.1, 0.0}, 1.3 * X, 0.9 * Y);
  const std::vector<Polygon> others{rectangle({0.2, 0.1, 0.0}, 0.9 * Y, Z), rectangle({0.0, 0.0, 0.3}, Y, X),
                                    rectangle({3.0, 1.0, 2.0}, Y, X + 0.3 * Z), rectangle({-0.4, 0.0, -0.5}, Y, Z)};
  for (const Polygon& other : others) {
    const Patch q = make_patch(other);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
      sum += exchange(make_patch(rectangle({0.2 + 0.65 * (i % 2), 0.1 + 0.45 * (i / 2), 0.0}, 0.65 * X, 0.45 * Y)), q);
    }
    CHECK(exchange(make_patch(whole), q) == test::Approx(sum).epsilon(2e-5));
  }
}

TEST_CASE("what lies behind the horizon gets nothing, a patch across the horizon gets its upper part") {
  const Patch floor = make_patch(rectangle(O, X, Y));
  CHECK(exchange(floor, make_patch(rectangle({0.0, 0.0, -1.0}, Y, X))) == 0.0);
  CHECK(exchange(floor, make_patch(rectangle({2.0, 0.0, 0.0}, X, Y))) == 0.0);  // coplanar
  CHECK(exchange(floor, make_patch(rectangle({0.0, 0.0, 1.0}, X, Y))) == 0.0);  // back to front
  const double upper = exchange(floor, make_patch(rectangle({0.0, 0.0, 0.0}, Y, Z)));
  CHECK(exchange(floor, make_patch(rectangle({0.0, 0.0, -1.0}, Y, 2.0 * Z))) == test::Approx(upper).epsilon(1e-9));
}

TEST_CASE("scaling by a power of two scales the exchange exactly, moving changes nothing beyond rounding") {
  const Polygon p = rectangle({0.1, 0.2, 0.0}, 0.7 * X, 0.9 * Y);
  const Polygon q = rectangle({0.3, 0.1, 0.6}, 0.8 * Y, 0.5 * X + 0.2 * Z);
  const double g = exchange(make_patch(p), make_patch(q));
  for (const double s : {0x1p-20, 0x1p20}) {
    Polygon ps = p;
    Polygon qs = q;
    for (glm::dvec3& x : ps) { x *= s; }
    for (glm::dvec3& x : qs) { x *= s; }
    CHECK(exchange(make_patch(ps), make_patch(qs)) / (s * s) == test::Approx(g).epsilon(1e-12));
  }
}

TEST_CASE("Lambert's contour: a point sees a half space of 1 and a quarter of 1/2") {
  const double far = 1e9;
  const Polygon sky = rectangle({-far, -far, 1.0}, 2.0 * far * Y, 2.0 * far * X);
  CHECK(radiosity::point_to_polygon(O, Z, sky) == test::Approx(1.0).epsilon(1e-8));
  CHECK(radiosity::point_to_polygon(O, Z, rectangle({0.0, -far, 1e-6}, 2.0 * far * Y, far * X)) == test::Approx(0.5).epsilon(1e-6));
  // Close to the foot of a perpendicular wall a point sees half the sky covered; atan2 keeps that exact.
  CHECK(radiosity::point_to_polygon(1e-3 * X, Z, rectangle({0.0, -far, 0.0}, 2.0 * far * Y, far * Z)) == test::Approx(0.5).epsilon(1e-8));
}

TEST_CASE("the light vector gives Lambert's contour for every normal") {
  std::mt19937_64 engine{20240612};
  INFO("seed 20240612");
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  const glm::dvec3 x{0.1, -0.2, 0.3};
  for (int trial = 0; trial < 50; ++trial) {
    const glm::dvec3 n = glm::normalize(glm::dvec3{uniform(engine), uniform(engine), 1.5});
    const glm::dvec3 a = x + 3.0 * n + glm::dvec3{uniform(engine), uniform(engine), 0.0};
    const glm::dvec3 along{-0.1, 0.4 + 0.3 * uniform(engine), 0.0};
    const glm::dvec3 across{1.5 + 0.5 * uniform(engine), 0.0, 0.1};
    const Polygon lamp = rectangle(a, along, across);  // all of it above the horizon, and turned to x
    const double expected = radiosity::point_to_polygon(x, n, lamp);
    CHECK(expected > 0.0);
    CHECK(std::abs(glm::dot(n, radiosity::light_vector(x, lamp)) - expected) < 1e-14);
  }
}

TEST_CASE("the disk estimate is never above 1 and tends to the contour value far away") {
  for (const double h : {1e-6, 1e-3, 1.0, 10.0, 100.0}) {
    const double estimate = radiosity::disk_estimate({0.5, 0.5, 0.0}, Z, {0.5, 0.5, h}, -Z, 1.0);
    CHECK(estimate <= 1.0);
    if (h >= 10.0) {  // relative difference of disk and square: second order in size / distance, below 0.1 (1/h)^2
      const double exact = radiosity::point_to_polygon({0.5, 0.5, 0.0}, Z, rectangle(h * Z, Y, X));
      CHECK(std::abs(estimate - exact) < 0.2 / (h * h) * exact);
    }
  }
  CHECK(radiosity::disk_estimate(O, Z, Z, Z, 1.0) == 0.0);   // turned away
  CHECK(radiosity::disk_estimate(O, Z, -Z, Z, 1.0) == 0.0);  // below
}

TEST_CASE("the exchange integral agrees with Lambert's contour averaged over one patch") {
  const Polygon p = rectangle({0.0, 0.0, 0.0}, X, Y);
  const Polygon q = rectangle({0.4, 0.2, 0.8}, 0.7 * Y, 0.6 * X - 0.3 * Z);
  double mean = 0.0;
  constexpr int n = 64;  // midpoint rule: error O(1/n^2) of a smooth integrand
  for (int i = 0; i < n * n; ++i) { mean += radiosity::point_to_polygon({(i % n + 0.5) / n, (i / n + 0.5) / n, 0.0}, Z, q) / (n * n); }
  CHECK(form_factor(p, q) == test::Approx(mean).epsilon(1e-4));
}

TEST_CASE("degenerate patches exchange nothing") {
  const Patch line = make_patch({O, X, 2.0 * X});
  const Patch wall = make_patch(rectangle(Z, Y, X));
  CHECK(line.area == 0.0);
  CHECK(exchange(line, wall) == 0.0);
  CHECK(exchange(wall, line) == 0.0);
}

TEST_CASE("needles: patches of any aspect exchange at most their area, in bounded time") {
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-12}) {
    CAPTURE(width);
    const glm::dvec3 tilted = glm::normalize(glm::dvec3{1.0, 0.2, 0.3});
    const Patch needle = make_patch(rectangle(O, Y, width * tilted));
    const Patch wall = make_patch(rectangle({0.0, 0.0, -0.5}, 2.0 * Y, X));
    const double there = exchange(needle, wall);
    const double back = exchange(wall, needle);
    CHECK(there >= 0.0);
    CHECK(there <= needle.area);
    CHECK(std::abs(there - back) <= 1e-3 * needle.area);
  }
}
