// SPDX-License-Identifier: MIT
// Points of indirect light: what lies between them.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <radiosity/camera/indirect_points.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;

// A point of the plane z = 0, of which pixel (x, y) shows the square from (x, y) to (x + 1, y + 1), in hundredths.
radiosity::IndirectPoint point_at(double x, double y, double radius, const Color& light) {
  radiosity::IndirectPoint point;
  point.position = {0.01 * x, 0.01 * y, 0.0};
  point.normal = {0.0, 0.0, 1.0};
  point.x = static_cast<std::uint32_t>(x);
  point.y = static_cast<std::uint32_t>(y);
  point.radius = 0.01 * radius;
  point.pixels = radius;
  point.widest = point.radius;
  point.widest_pixels = radius;
  point.gathered = light;
  return point;
}

}  // namespace

// A least-squares plane through values of a linear field is the field, whatever the weights; so is every blend of such planes. What holds
// the slopes down takes 0.001 / variance of them: 2 % where the points of a sphere spread by 0.22 of its radius, which is little for ten of
// them.
TEST_CASE("between points of indirect light a linear field is exact, wherever the points are") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    const auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
    const Color middle{uniform(5, 9), uniform(5, 9), uniform(5, 9)}, by_x{uniform(-2, 2), uniform(-2, 2), 0.0},
        by_y{uniform(-2, 2), 0.0, 1.0};
    const auto field = [&](double x, double y) { return middle + 0.01 * x * by_x + 0.01 * y * by_y; };
    radiosity::IndirectPoints points{100, 80};
    for (int k = 0; k < 150; ++k) {
      const double x = uniform(0, 100), y = uniform(0, 80);
      points.add(point_at(x, y, uniform(15, 30), field(x, y)));
    }
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    for (int k = 0; k < 300; ++k) {
      const double x = uniform(10, 90), y = uniform(10, 70);
      const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
      REQUIRE(found);
      CHECK(glm::length(*found - field(x, y)) < 0.02 * 0.3 * glm::length(glm::abs(by_x) + glm::abs(by_y)));
    }
  }
}

// The variance of a weighted fit falls with the number of points in the sphere: with the square of its radius. Three times the radius takes
// two thirds of the noise away; half of it is asked for, because at the border of the picture spheres are cut off.
TEST_CASE("noise of indirect light falls with the sphere of the fit, where a plane explains the light") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    double square[2] = {0.0, 0.0};
    for (const int wide : {0, 1}) {
      radiosity::Random random{seed, 0};
      radiosity::IndirectPoints points{200, 200};
      for (int k = 0; k < 1000; ++k) {
        const double x = 200 * random.uniform(), y = 200 * random.uniform();
        const double light = 6.0 + 0.01 * x - 0.02 * y;
        // Uniform noise of standard deviation 0.2 in each channel, the same in all: the sum has three times that.
        radiosity::IndirectPoint point = point_at(x, y, 12, Color{light + 0.2 * std::sqrt(12.0) * (random.uniform() - 0.5)});
        point.variance = 0.6 * 0.6;
        point.widest = (wide ? 3.0 : 1.0) * point.radius;
        point.widest_pixels = (wide ? 3.0 : 1.0) * point.pixels;
        points.add(point);
      }
      for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
      for (int k = 0; k < 500; ++k) {
        const double x = 200 * random.uniform(), y = 200 * random.uniform();
        const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
        if (found) { square[wide] += std::pow(found->x - (6.0 + 0.01 * x - 0.02 * y), 2); }
      }
    }
    CHECK(square[1] < 0.25 * square[0]);
  }
}

// A step of 30 standard deviations is not noise: what is farther from it than a sphere's radius keeps its light. The largest of some
// hundred errors of points that have each some ten neighbours stays below the noise of one point by far more often than not; three of it
// are allowed.
TEST_CASE("a wide fit does not carry indirect light over a step") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    radiosity::IndirectPoints points{200, 200};
    constexpr double noise = 0.1;
    const auto truth = [](double x) { return x < 100 ? 2.0 : 2.0 + 30 * noise; };
    for (int k = 0; k < 1000; ++k) {
      const double x = 200 * random.uniform(), y = 200 * random.uniform();
      radiosity::IndirectPoint point = point_at(x, y, 12, Color{truth(x) + noise * std::sqrt(12.0) * (random.uniform() - 0.5)});
      point.variance = 9 * noise * noise;
      point.widest = 3.0 * point.radius;
      point.widest_pixels = 3.0 * point.pixels;
      points.add(point);
    }
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    for (int k = 0; k < 500; ++k) {
      const double x = 200 * random.uniform(), y = 200 * random.uniform();
      if (std::abs(x - 100) < 25) { continue; }  // the sphere of a point that lies a radius away
      const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
      REQUIRE(found);
      CHECK(std::abs(found->x - truth(x)) < 3.0 * noise);
    }
  }
}

// In the gap above a lamp light is far brighter than around it, and points crowd there. Each stands for its own sphere, so that the gap
// counts by its area: means carry out of it what it holds at most, and planes stay within twice that.
TEST_CASE("a crowd of points in a bright gap does not draw the light beside it to itself") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    radiosity::IndirectPoints points{200, 200};
    const auto in_gap = [](double x) { return x > 100 && x < 104; };
    const auto add = [&](double x, double radius) {
      radiosity::IndirectPoint point = point_at(x, 200 * random.uniform(), radius, Color{in_gap(x) ? 8.0 : 1.0});
      point.variance = 1e-6;
      point.widest = 3.0 * point.radius;
      point.widest_pixels = 3.0 * point.pixels;
      points.add(point);
    };
    for (int k = 0; k < 600; ++k) { add(100 + 4 * random.uniform(), 2.0); }
    for (int k = 0; k < 400; ++k) {
      const double x = 200 * random.uniform();
      if (!in_gap(x)) { add(x, 20.0); }
    }
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    double carried = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const double x = 200 * random.uniform(), y = 200 * random.uniform();
      const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
      if (found && !in_gap(x)) { carried += std::abs(found->x - 1.0) / 4000; }
    }
    CHECK(carried < 2.0 * 7.0 * 4 / 200);
  }
}

TEST_CASE("a point of indirect light says nothing about another object, another side of a crease, or what lies off its plane") {
  radiosity::IndirectPoints points{100, 80};
  points.add(point_at(50, 40, 20, Color{1.0}));
  points.fit(0);
  const glm::dvec3 place{0.5, 0.4, 0.0}, up{0, 0, 1};
  CHECK(points.covered(50, 40, place, up, 0));
  CHECK(points.at(50, 40, place, up, 0) == Color{1.0});
  CHECK_FALSE(points.at(50, 40, place, up, 1));
  CHECK_FALSE(points.at(50, 40, place, glm::normalize(glm::dvec3{1, 0, 1}), 0));
  CHECK_FALSE(points.at(50, 40, place + glm::dvec3{0, 0, 0.05}, up, 0));
  CHECK_FALSE(points.at(71, 40, place + glm::dvec3{0.201, 0, 0}, up, 0));
}

// Beside a lamp light falls off faster than any plane. Its colour is the same everywhere, and so is that of what lies between the points,
// for planes are linear in the light and bounds hold all channels by the same part.
TEST_CASE("between points of indirect light it stays within a factor of two of theirs, in their colour") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    radiosity::IndirectPoints points{200, 200};
    double least = 1e30, most = 0.0;
    for (int k = 0; k < 400; ++k) {
      const double x = 200 * random.uniform(), y = 200 * random.uniform();
      const double light = 1.0 / (1e-3 + 1e-4 * (x * x + y * y));
      least = std::min(least, light);
      most = std::max(most, light);
      radiosity::IndirectPoint point = point_at(x, y, 20, light * Color{1.0, 0.5, 0.25});
      point.variance = std::pow(0.01 * light, 2);
      points.add(point);
    }
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    for (int k = 0; k < 2000; ++k) {
      const double x = 200 * random.uniform(), y = 200 * random.uniform();
      const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
      if (!found) { continue; }
      CHECK(found->x >= 0.5 * least);
      CHECK(found->x <= 2.0 * most);
      CHECK(std::abs(found->y - 0.5 * found->x) <= 1e-9 * found->x);
      CHECK(std::abs(found->z - 0.25 * found->x) <= 1e-9 * found->x);
    }
  }
}

// Points of a plane with honest noise of 2 %, and some that are a fifth too dark and say that they have no more noise than the others. A
// point is off its plane by 2.5 standard errors once in 80 times.
TEST_CASE("indirect points that lie off those around them are gathered once more, and hardly any others") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    radiosity::Random random{seed, 0};
    radiosity::IndirectPoints points{200, 200};
    constexpr std::size_t count = 1000, stains = 10;
    const auto field = [](const glm::dvec3& p) { return 6.0 + p.x - 2.0 * p.y; };
    std::vector<double> truth;
    for (std::size_t k = 0; k < count; ++k) {
      const double x = 10 + 180 * random.uniform(), y = 10 + 180 * random.uniform();
      const double light = field({0.01 * x, 0.01 * y, 0.0});
      const double part = k < stains ? 0.8 : 1.0 + 0.02 * std::sqrt(12.0) * (random.uniform() - 0.5);
      radiosity::IndirectPoint point = point_at(x, y, 12, Color{light * part});
      point.variance = 9.0 * 0.02 * 0.02 * light * light;
      point.widest = 3.0 * point.radius;
      point.widest_pixels = 3.0 * point.pixels;
      points.add(point);
      truth.push_back(light);
    }
    std::vector<char> again(count, 0);
    const bool done = points.gather_again(1, {}, [&](std::size_t i) {
      again[i] = 1;
      return radiosity::FinalGather::Indirect{Color{truth[i]}, 1e-6, 1.0};
    });
    const auto found = std::count(again.begin(), again.begin() + stains, 1), others = std::count(again.begin() + stains, again.end(), 1);
    CAPTURE(seed, found, others);
    CHECK(done);
    CHECK(found == stains);
    CHECK(others <= 40);
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    for (int k = 0; k < 300; ++k) {
      const double x = 20 + 160 * random.uniform(), y = 20 + 160 * random.uniform();
      const glm::dvec3 place{0.01 * x, 0.01 * y, 0.0};
      const auto light = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), place, {0, 0, 1}, 0);
      if (light) { CHECK(std::abs(light->x / field(place) - 1.0) < 0.04); }
    }
  }
}

// Under an eave the light of a wall falls off within the eave's width, and from below it few rays tell of it: in the mean they go far.
TEST_CASE("the sphere of a point of indirect light ends before what few of its rays meet is near", "[picture]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  const radiosity::Options options{.epsilon = 0.5, .audit_points = 0};
  for (int round = 0; round < 6; ++round) {
    const double width = 0.02 * std::pow(20.0, random.uniform());
    radiosity::Scene scene{{{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"sky", radiosity::Color{0.0}, radiosity::Color{1.0}}},
                           {}};
    scene.objects = {scenes::object("world", scenes::box({-30, -30, 0}, {30, 30, 20}), 1, true),
                     scenes::object("wall", scenes::box({0, -4, 0}, {1, 4, 3}), 0),
                     scenes::object("eave", scenes::box({-width, -4, 3}, {1, 4, 3.1}), 0)};
    scene.objects[0].material = {1, 1, 1, 1, 0, 1};
    const radiosity::Solution solution = scenes::solved(scene, options);
    const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
    for (int i = 0; i < 20; ++i) {
      const double below = width * 0.2 * std::pow(50.0, random.uniform());
      const glm::dvec3 x{0, 2.0 * random.uniform() - 1.0, 3.0 - below};
      if (below > 1.5) { continue; }
      const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {-1, 0, 0}}, 1, 6};
      const auto found = light.indirect(place, {512, 512, 0.03}, random.bits());
      const double seen = 0.5 * (1.0 - below / std::hypot(below, width)), nearest = found.nearest / solution.frame.scale;
      CAPTURE(width, below, seen, nearest);
      CHECK(nearest > 0.99 * below);
      // Five of 512 rays are asked for; of even ones fifteen or more meet an eave of which so much is seen, a third of them straight above.
      if (seen > 0.03) { CHECK(nearest < 1.5 * std::hypot(below, width)); }
      const auto point = radiosity::indirect_point(found, {0, 0}, place, place.point.position + glm::dvec3{-1, 0, 0}, 0.2 * found.nearest);
      CHECK(point.radius <= 0.76 * found.nearest);
    }
  }
}

// A pixel of a slanted surface is up to five pixels long but one wide. Where the gather allows a sphere of half a pixel, as beside a window
// or above a lamp under the ceiling, one of two such lengths carried the light of a gap over ten pixels across.
TEST_CASE("a point of indirect light reaches at most a pixel where the gather allows less, however slanted the surface is") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 100; ++k) {
    const double slant = 1.5 * random.uniform(), turn = 6.283185307179586 * random.uniform(), pixel = 0.001 + 0.1 * random.uniform();
    const radiosity::FinalGather::Place place{{{0, 0, 0}, {0, 0, 1}}, 0, 0};
    const glm::dvec3 eye{std::sin(slant) * std::cos(turn), std::sin(slant) * std::sin(turn), std::cos(slant)};
    radiosity::FinalGather::Indirect found;
    found.irradiance = Color{1.0};
    found.nearest = 0.5 * pixel;
    found.nearness = 1.0 / found.nearest;
    const auto point = radiosity::indirect_point(found, {0, 0}, place, eye, pixel);
    CAPTURE(slant, turn, pixel, point.radius);
    CHECK(point.radius <= pixel * (1.0 + 1e-12));
    CHECK(point.widest >= point.radius);
  }
}
