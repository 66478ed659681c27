// SPDX-License-Identifier: MIT

// The exchange of a cluster of lamps with a patch: what its faces exchange one by one, the same light in all directions, the light of those
// that are seen.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/clusters/lamp_exchange.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "random_points.hpp"
#include "scenes.hpp"
#include "seed.hpp"

using radiosity::Color;
using radiosity::Scene;
using scenes::point;
using scenes::uniform;

namespace {

std::unique_ptr<radiosity::DiscreteScene> with_lamp_clusters(const Scene& scene) {
  radiosity::PrepareResult made = radiosity::prepare(scene);
  REQUIRE(made.prepared);
  auto discrete = std::make_unique<radiosity::DiscreteScene>(scene, 1u, 1u);
  discrete->take(std::move(*made.prepared));
  discrete->hierarchy = radiosity::make_lamp_clusters(discrete->surfaces, radiosity::make_roots(discrete->surfaces), discrete->emission);
  discrete->expose();
  discrete->shown = discrete->exposed_shown();
  return discrete;
}

radiosity::LampExchange exchange_of(const radiosity::DiscreteScene& scene) {
  std::vector<double> emission;
  for (const Color& e : scene.emission) { emission.push_back(radiosity::brightest(e)); }
  return {scene.view(), &scene.exposure, scene.shown, emission};
}

std::uint32_t top_cluster(const radiosity::Hierarchy& hierarchy) {
  std::uint32_t top = 0;
  for (std::uint32_t i = 1; i < hierarchy.size(); ++i) {
    if (hierarchy[i].is_cluster() && hierarchy[i].parent == radiosity::no_node) { top = i; }
  }
  REQUIRE(top > 0);
  return top;
}

}  // namespace

TEST_CASE("a cluster of lamps exchanges with a patch what its faces do, one by one", "[lamps]") {
  const std::uint64_t seed = 3;
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (const std::uint32_t n : {3u, 8u, 12u, 24u}) {  // 24 to 2208 faces
    for (int k = 0; k < 6; ++k) {
      Scene scene;
      scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1.0}}};
      const double distance = uniform(random, 0.5, 1.5);
      const double half = uniform(random, 0.02, 0.18);
      const glm::dvec3 at = distance * glm::normalize(point(random, -1.0, 1.0));
      const glm::dvec3 u = half * glm::normalize(glm::cross(at, point(random, -1.0, 1.0)));
      const glm::dvec3 v = glm::cross(u, glm::normalize(at + 0.5 * distance * glm::normalize(point(random, -1.0, 1.0))));
      scene.objects = {scenes::plate("wall", {at - u - v, at - u + v, at + u + v, at + u - v}),
                       scenes::object("lamp", scenes::ball({0, 0, 0}, 0.1, n), 1)};
      const auto discrete = with_lamp_clusters(scene);
      const radiosity::LampExchange lamps = exchange_of(*discrete);
      REQUIRE(!discrete->hierarchy[0].is_cluster());
      double sum = 0.0;
      const std::uint32_t top = top_cluster(discrete->hierarchy);
      for (std::uint32_t i = 1; i < discrete->hierarchy.size(); ++i) {
        const radiosity::Node& node = discrete->hierarchy[i];
        if (!node.is_cluster()) { sum += radiosity::exchange(discrete->patches[0], discrete->patches[i]); }
      }
      const auto result = lamps(top, 0, 4, radiosity::Random{seed, static_cast<std::uint64_t>(k)});
      CAPTURE(n, k, distance, half, sum, result.sent);
      CHECK(result.fraction == 1.0);
      // Gauss points of an end of radius a at the distance d err by some (a / d)^4: 1.5 (a + b) = d at most gives 1 %. Beyond 256 faces
      // each point stands for some of them; 256 of even area err by about as much.
      CHECK(std::abs(result.sent - sum) <= 0.02 * sum);
    }
  }
}

TEST_CASE("a bulb of many faces sends the same light in all directions", "[lamps]") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (const std::uint32_t n : {16u, 24u}) {  // 960 and 2208 faces
    constexpr double r = 0.1, distance = 0.3;
    constexpr std::uint32_t count = 48;
    Scene scene;
    scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1.0}}};
    for (std::uint32_t k = 0; k < count; ++k) {  // small plates that face it, in random directions
      const double z = uniform(random, -1.0, 1.0), turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
      const glm::dvec3 way{std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
      const glm::dvec3 u = 1e-3 * glm::normalize(glm::cross(way, point(random, -1.0, 1.0))), v = glm::cross(u, way);
      const glm::dvec3 at = distance * way;
      scene.objects.push_back(scenes::plate("plate", {at - u - v, at + u - v, at + u + v, at - u + v}));
    }
    scene.objects.push_back(scenes::object("lamp", scenes::ball({0, 0, 0}, r, n), 1));
    const auto discrete = with_lamp_clusters(scene);
    const radiosity::LampExchange lamps = exchange_of(*discrete);
    const std::uint32_t top = top_cluster(discrete->hierarchy);
    double square = 0.0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const double sent = lamps(top, k, 0, radiosity::Random{seed, k}).sent / discrete->patches[k].area;
      square += std::pow(sent * distance * distance / (r * r) - 1.0, 2.0) / count;
    }
    CAPTURE(n, std::sqrt(square));
    CHECK(std::sqrt(square) < 0.014);  // found: .008 to .010; with every fourth or ninth face in the order of the tree .02 to .03
  }
}

TEST_CASE("a cluster of lamps that do not shine alike sends the light of those that are seen", "[lamps]") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (int k = 0; k < 12; ++k) {
    // Two lamps, of which a screen may hide one from a small plate.
    const bool hidden = k % 2 == 1;
    const double bright = uniform(random, 1.0, 3.9), aside = uniform(random, 0.3, 0.6), size = uniform(random, 0.03, 0.1);
    Scene scene;
    scene.materials = {{"grey", Color{0.5}, Color{0.0}}, {"dim", Color{0.0}, Color{1.0}}, {"bright", Color{0.0}, Color{bright}}};
    scene.objects = {scenes::plate("plate", {{-0.1, -0.1, -3}, {0.1, -0.1, -3}, {0.1, 0.1, -3}, {-0.1, 0.1, -3}}),
                     scenes::object("dim", scenes::ball({-aside, 0, 0}, uniform(random, 0.03, 0.1), 6), 1),
                     scenes::object("bright", scenes::ball({aside, 0, 0}, size, 6), 2)};
    if (hidden) { scene.objects.push_back(scenes::object("screen", scenes::box({0.05, -1, -0.3}, {2, 1, -0.2}), 0)); }
    const auto discrete = with_lamp_clusters(scene);
    const radiosity::LampExchange lamps = exchange_of(*discrete);
    double area = 0.0, power = 0.0, expected = 0.0;
    for (std::uint32_t i = 1; i < discrete->hierarchy.size(); ++i) {
      const radiosity::Node& node = discrete->hierarchy[i];
      const double exitance = node.is_cluster() ? 0.0 : discrete->emission[node.surface].x;
      if (!(exitance > 0.0)) { continue; }
      area += node.area;
      power += node.area * exitance;
      if (!hidden || node.object == 1) { expected += exitance * radiosity::exchange(discrete->patches[0], discrete->patches[i]); }
    }
    constexpr int draws = 2000;  // of one round each, which has no bias
    const std::uint32_t top = top_cluster(discrete->hierarchy);
    double sum = 0.0;
    for (int i = 0; i < draws; ++i) {
      const auto result = lamps(top, 0, 1, radiosity::Random{seed, static_cast<std::uint64_t>(draws * k + i)});
      sum += result.sent * result.fraction / draws;
    }
    CAPTURE(k, bright, aside, size);
    CHECK(sum * power / area == test::Approx(expected).epsilon(0.05));
  }
}

TEST_CASE("rounds of segments to a cluster of lamps give the visible share on average, through narrow slits, too") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (int run = 0; run < 6; ++run) {
    // A round lamp over a plate, between them two screens that leave a slit.
    const double at = uniform(random, -0.05, 0.05), half = 0.5 * std::exp(uniform(random, -6.0, -3.0));
    Scene scene;
    scene.materials = {{"grey", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1.0}}};
    const auto strip = [](double from, double to, double z) {
      return std::vector<glm::dvec3>{{from, -2.0, z}, {to, -2.0, z}, {to, 2.0, z}, {from, 2.0, z}};
    };
    scene.objects = {scenes::plate("plate", {{-0.1, -0.1, -1}, {0.1, -0.1, -1}, {0.1, 0.1, -1}, {-0.1, 0.1, -1}}),
                     scenes::object("lamp", scenes::ball({0, 0, 0}, 0.1, 8), 1), scenes::plate("screen", strip(-2.0, at - half, -0.5)),
                     scenes::plate("screen", strip(at + half, 2.0, -0.5))};
    const auto discrete = with_lamp_clusters(scene);
    const radiosity::LampExchange lamps = exchange_of(*discrete);
    const std::uint32_t top = top_cluster(discrete->hierarchy);
    // A single round does not decide about others: its mean is the share.
    constexpr std::uint64_t count = 4000;
    struct Mean {
      double sum = 0.0, square = 0.0;
      [[nodiscard]] double value() const { return sum / count; }
      [[nodiscard]] double variance() const { return (square / count - value() * value()) / (count - 1); }
    } one, four;
    for (std::uint64_t k = 0; k < 2 * count; ++k) {
      Mean& mean = k < count ? one : four;
      const double share = lamps(top, 0, k < count ? 1 : 4, radiosity::Random{seed, k}).fraction;
      mean.sum += share;
      mean.square += share * share;
    }
    CAPTURE(run, at, half, one.value(), four.value());
    // As in visibility_test.cpp; 60 % and more of shares up to 0.02 were lost where the first round decided alone what is hidden.
    CHECK(std::abs(four.value() - one.value()) < 0.35 * one.value() + 4.5 * std::sqrt(one.variance() + four.variance()));
  }
}
