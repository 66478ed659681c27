// SPDX-License-Identifier: MIT

// The law of stated errors: of form factors whose true value is known, at least 93 % lie within twice the stated error, and it is 0 only
// where nothing can arrive.

#include <cmath>
#include <numbers>
#include <random>

#include <raycast/objects/disk.hpp>
#include <raycast/objects/sphere.hpp>

#include "catch.hpp"
#include "factors_of.hpp"
#include "scenes.hpp"

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/factors/factor_rows.hpp>
#include <radiosity/factors/factor_run.hpp>
#include <radiosity/factors/factors.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace factor_errors {

using radiosity::Estimate;
using radiosity::Factors;
using radiosity::Polygon;
using radiosity::Scene;
using scenes::grey;

// How many of the factors of a family lie within their interval.
struct Coverage {
  std::string family;
  int inside = 0, all = 0;
  double worst = 0.0;  // error by half the interval

  void count(const Estimate& stated, double right) {
    ++all;
    const double off = std::abs(stated.value - right);
    inside += off <= 2.0 * stated.error + 1e-15;
    CHECK(stated.error > 0.0);
    worst = std::max(worst, off / (2.0 * stated.error));
  }
  void check() const {
    CAPTURE(family, inside, all, worst);
    CHECK(all >= 20);
    CHECK(inside >= 0.93 * all);
  }
};

Factors run(const Scene& scene, std::uint64_t seed, double error) {
  const radiosity::FactorOptions options{.error = error, .threads = 1, .seed = seed};
  radiosity::FactorsResult result = radiosity::factors(scene, options);
  REQUIRE(result.factors);
  return std::move(*result.factors);
}

struct Random {
  std::mt19937_64 engine;
  double uniform(double a, double b) { return std::uniform_real_distribution<double>{a, b}(engine); }
  double decades(double a, double b) { return a * std::pow(b / a, uniform(0.0, 1.0)); }
};

// Gauss rule of four points over each of the pieces between the cuts that lie in [0, 1].
template <class Function>
double pieces(std::vector<double> cuts, const Function& f) {
  cuts.push_back(0.0);
  cuts.push_back(1.0);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double a = std::clamp(cuts[k], 0.0, 1.0);
    const double size = (std::clamp(cuts[k + 1], 0.0, 1.0) - a) / 4.0;
    for (int part = 0; part < (size > 0.0 ? 4 : 0); ++part) {
      for (std::size_t i = 0; i < 4; ++i) {
        sum += size * radiosity::detail::gauss4_w[i] * f(a + size * (part + radiosity::detail::gauss4_x[i]));
      }
    }
  }
  return sum;
}

// Unit squares z = 0 and z = 1 that face each other. What passes the window [a, b] x [c, d] at height z: from (x, y) it shows a rectangle
// of the upper square, bounded by the window or by the square; where that changes the integral is cut.
double through_window(double a, double b, double c, double d, double z) {
  const auto cuts = [&](double lo, double hi) {
    std::vector<double> result;
    for (const double e : {lo, hi}) {
      for (const double end : {0.0, 1.0}) { result.push_back((e - z * end) / (1.0 - z)); }
      result.push_back(e);
    }
    return result;
  };
  const auto seen = [&](double from, double edge) { return std::clamp(from + (edge - from) / z, 0.0, 1.0); };
  return pieces(cuts(a, b), [&](double x) {
    return pieces(cuts(c, d), [&](double y) {
      const double x0 = seen(x, a);
      const double x1 = seen(x, b);
      const double y0 = seen(y, c);
      const double y1 = seen(y, d);
      if (!(x1 > x0) || !(y1 > y0)) { return 0.0; }
      return radiosity::point_to_polygon({x, y, 0}, {0, 0, 1}, Polygon{{x0, y0, 1}, {x0, y1, 1}, {x1, y1, 1}, {x1, y0, 1}});
    });
  });
}

Polygon rectangle(double a, double b, double c, double d, double z) { return {{a, c, z}, {b, c, z}, {b, d, z}, {a, d, z}}; }
Scene squares() {
  Scene scene = grey();
  scene.objects = {scenes::object("P", scenes::polygon(rectangle(0, 1, 0, 1, 0))),
                   scenes::object("Q", scenes::polygon({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}))};
  return scene;
}

TEST_CASE("errors of factors: slits from a ten thousandth of the width on, through some of which little arrives") {
  const unsigned seed = 3;
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  Coverage coverage{"slits"};
  for (int trial = 0; trial < 60; ++trial) {
    const double width = random.decades(1e-4, 0.1);
    const double z = random.uniform(0.1, 0.9);
    const double a = trial % 3 == 0 ? 1.0 - random.uniform(0.0, 2.0) * width : random.uniform(0.0, 1.0 - width);
    Scene scene = squares();
    scene.objects.push_back(scenes::object("left", scenes::polygon(rectangle(-20, a, -20, 20, z))));
    scene.objects.push_back(scenes::object("right", scenes::polygon(rectangle(a + width, 20, -20, 20, z))));
    const Factors f = run(scene, static_cast<std::uint64_t>(trial), 1e-3);
    CHECK(f.converged);
    coverage.count(f(0, 1), through_window(a, a + width, -20, 20, z));
  }
  coverage.check();
}

TEST_CASE("errors of factors: small blockers, near a surface or between") {
  const unsigned seed = 4;
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  Coverage coverage{"blockers"};
  const double open = through_window(-20, 20, -20, 20, 0.5);
  for (int trial = 0; trial < 60; ++trial) {
    const double a = random.uniform(0.0, 0.9);
    const double c = random.uniform(0.0, 0.9);
    const double b = a + random.decades(1e-3, 0.3);
    const double d = c + random.decades(1e-3, 0.3);
    const double z = trial % 2 == 0 ? random.decades(1e-3, 0.5) : 1.0 - random.decades(1e-3, 0.5);
    Scene scene = squares();
    scene.objects.push_back(scenes::object("blocker", scenes::polygon(rectangle(a, b, c, d, z))));
    const Factors f = run(scene, static_cast<std::uint64_t>(trial), 1e-3);
    coverage.count(f(0, 1), open - through_window(a, b, c, d, z));
  }
  coverage.check();
}

TEST_CASE("errors of factors: what hides all of a surface gives exactly 0") {
  Scene scene = squares();
  scene.objects.push_back(scenes::object("wall", scenes::polygon(rectangle(-1, 2, -1, 2, 0.5))));
  const Factors f = run(scene, 1, 1e-3);
  CHECK(f(0, 1).value == 0.0);
  CHECK(f(0, 1).error == 0.0);
}

TEST_CASE("errors of factors: a ball that rises above the plane of a disk by less than its mesh shows is not called dark for certain") {
  for (const double height : {1e-4, 1e-6}) {
    Scene scene = grey();
    scene.objects = {scenes::object("ball", raycast::Sphere::make({0, 0, height - 1.0}, 1.0).object),
                     scenes::object("disk", raycast::Disk::make({2, 0, 0}, {0, 0, 1}, 0.5).object)};
    const Estimate rising = run(scene, 1, 1e-3)(0, 1);
    CHECK(rising.value + rising.error > 0.0);
    CHECK(rising.value + rising.error < 1e-3);
    scene.objects[0] = scenes::object("ball", raycast::Sphere::make({0, 0, -1.2}, 1.0).object);
    CHECK(run(scene, 1, 1e-3)(0, 1).error == 0.0);
  }
}

TEST_CASE("errors of factors: disks and spheres on one axis, from touching nearly to far apart", "[accuracy]") {
  const unsigned seed = 5;
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  Coverage disks{"disks"};
  Coverage spheres{"spheres"};
  for (int trial = 0; trial < 20; ++trial) {
    const double h = random.decades(1e-3, 50.0);
    const double r = trial % 3 == 0 ? 1.0 : random.decades(0.2, 5.0);
    Scene scene = grey();
    scene.objects = {scenes::object("one", raycast::Disk::make({0, 0, 0}, {0, 0, 1}, 1.0).object),
                     scenes::object("other", raycast::Disk::make({0, 0, h}, {0, 0, -1}, r).object)};
    const double x = 1.0 + (1.0 + r * r / (h * h)) * h * h;  // Howell C-41
    disks.count(run(scene, 1, 1e-3)(0, 1), 0.5 * (x - std::sqrt(x * x - 4.0 * r * r)));
    // Howell C-42; the centre 1 + h above the disk.
    scene.objects[1] = scenes::object("ball", raycast::Sphere::make({0, 0, 1.0 + h}, 1.0).object);
    scene.objects[0] = scenes::object("disk", raycast::Disk::make({0, 0, 0}, {0, 0, 1}, r).object);
    const double q = r / (1.0 + h);
    spheres.count(run(scene, 1, 1e-3)(1, 0), 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + q * q)));
  }
  disks.check();
  spheres.check();
}

TEST_CASE("errors of factors: few rays, a ball in a ball sees the outer one alone and is seen by (r / R)^2") {
  const unsigned seed = 6;
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  Coverage seen{"seen by the outer ball"};
  Coverage itself{"the outer ball by itself"};
  Coverage all{"all arrives"};
  Coverage none{"none arrives"};
  for (std::uint64_t trial = 0; trial < 150; ++trial) {
    const double r = random.decades(3e-3, 0.5);
    Scene scene = grey();
    scene.objects = {scenes::object("outer", raycast::Sphere::make({0, 0, 0}, 1.0).object, 0, true),
                     scenes::object("inner", raycast::Sphere::make({random.uniform(-0.4, 0.4), 0.1, 0.2}, r).object)};
    const auto prepared = radiosity::prepare(scene);
    REQUIRE(prepared.prepared);
    const radiosity::FactorRows rows = radiosity::name_rows(scene);
    const auto counted = [&](std::uint32_t from, std::uint64_t lines) {
      radiosity::RayCounter counter{prepared.prepared->objects, rows.row_of, {from, false, {}, from, 1, rows.row_of[from]}, 2, trial};
      counter.extend(lines, 1);
      const auto estimate = [&](std::uint32_t to) { return Estimate{counter.factor(from, to).value, counter.factor(from, to).error}; };
      return std::pair{estimate(0), estimate(1)};
    };
    const auto [outer_outer, outer_inner] = counted(0, trial % 2 == 0 ? 64 : 256);
    seen.count(outer_inner, r * r);
    itself.count(outer_outer, 1.0 - r * r);
    const auto [inner_outer, inner_inner] = counted(1, 16);
    all.count(inner_outer, 1.0);
    none.count(inner_inner, 0.0);
  }
  for (const Coverage& coverage : {seen, itself, all, none}) { coverage.check(); }
}

TEST_CASE("errors of factors: rectangles in the open, parallel and with a common edge") {
  const unsigned seed = 7;
  CAPTURE(seed);
  Random random{std::mt19937_64{seed}};
  Coverage coverage{"rectangles"};
  const double pi = std::numbers::pi;
  for (int trial = 0; trial < 100; ++trial) {
    const double a = random.decades(1e-2, 1.0);
    const double b = random.decades(1e-2, 1.0);
    const double c = random.decades(1e-3, 1.0);
    Scene scene = grey();
    const double x = a / c;
    const double y = b / c;
    scene.objects = {scenes::object("P", scenes::polygon(rectangle(0, a, 0, b, 0))),
                     scenes::object("Q", scenes::polygon({{0, 0, c}, {0, b, c}, {a, b, c}, {a, 0, c}}))};
    const double rx = std::sqrt(1.0 + x * x);
    const double ry = std::sqrt(1.0 + y * y);
    coverage.count(run(scene, 1, 1e-3)(0, 1),  // Howell C-11
                   2.0 / (pi * x * y) *
                       (0.5 * (std::log1p(x * x) + std::log1p(y * y) - std::log1p(x * x + y * y)) + x * ry * std::atan(x / ry) +
                        y * rx * std::atan(y / rx) - x * std::atan(x) - y * std::atan(y)));
    scene.objects[1] = scenes::object("wall", scenes::polygon({{0, 0, 0}, {0, b, 0}, {0, b, c}, {0, 0, c}}));
    const double h = c / b;
    const double w = a / b;
    const double s = h * h + w * w;
    const double logs = std::log1p(w * w) + std::log1p(h * h) - std::log1p(s) +
                        w * w * (std::log(w * w) + std::log1p(s) - std::log1p(w * w) - std::log(s)) +
                        h * h * (std::log(h * h) + std::log1p(s) - std::log1p(h * h) - std::log(s));
    coverage.count(
        run(scene, 1, 1e-3)(0, 1),  // Howell C-14
        (w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - std::sqrt(s) * std::atan(1.0 / std::sqrt(s)) + 0.25 * logs) / (pi * w));
  }
  coverage.check();
}

}  // namespace factor_errors
