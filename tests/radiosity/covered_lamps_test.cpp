// SPDX-License-Identifier: MIT

// Lamps that later surfaces in their plane cover, in part or wholly, light a point as rays say: what is covered shows nothing.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/polygon.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

namespace {

using radiosity::Color;
using radiosity::Random;
using radiosity::Scene;

struct InPlane {
  double x0, x1, y0, y1;
};
InPlane rectangle(Random& random) {
  const auto in = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  const double x = in(-0.4, 0.1), y = in(-0.4, 0.1);
  return {x, x + in(0.1, 0.5), y, y + in(0.1, 0.5)};
}

// At the height 1: a polygon that faces down, or the lower end of a box or of a cylinder.
std::shared_ptr<const raycast::Object> thing(const InPlane& r, int kind) {
  if (kind == 1) { return scenes::box({r.x0, r.y0, 1.0}, {r.x1, r.y1, 1.1}); }
  if (kind == 2) {
    const glm::dvec3 middle{0.5 * (r.x0 + r.x1), 0.5 * (r.y0 + r.y1), 1.0};
    return raycast::Cylinder::make(middle, {0, 0, 0.1}, 0.5 * std::min(r.x1 - r.x0, r.y1 - r.y0)).object;
  }
  return raycast::Polygon::make({{r.x0, r.y0, 1}, {r.x0, r.y1, 1}, {r.x1, r.y1, 1}, {r.x1, r.y0, 1}}).object;
}

// A floor, a lamp, and up to three covers in its plane, some of which are lamps that shine less.
Scene covered_lamp(Random& random) {
  Scene scene{{{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.5}, Color{1.0}}, {"dim", Color{0.5}, Color{0.3}}}, {}};
  const auto kind = [&] { return static_cast<int>(3.0 * random.uniform()); };
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::object("lamp", thing(rectangle(random), kind()), 1)};
  const int covers = 1 + kind();
  for (int k = 0; k < covers; ++k) {
    const InPlane place = random.uniform() < 0.2 ? InPlane{-0.5, 0.7, -0.5, 0.7} : rectangle(random);  // one in five covers it all
    const std::uint32_t material = random.uniform() < 0.5 ? 2 : 0;
    scene.objects.push_back(scenes::object("cover" + std::to_string(k), thing(place, kind()), material));
  }
  return scene;
}

// What rays from a point meet, as even as those of a rank-1 sequence: off by less than a random one's standard error.
Color by_rays(const Scene& scene, const radiosity::Prepared& prepared, const glm::dvec3& x, std::uint64_t key, std::uint32_t rays) {
  const radiosity::Sobol4 sequence{1, key};
  Color sum{0.0};
  for (std::uint32_t r = 0; r < rays; ++r) {
    const auto u = sequence(r);
    const glm::dvec3 direction = radiosity::cosine_direction({0, 0, 1}, u[0], u[1]);
    const auto hit = prepared.objects.closest({x, prepared.objects.diameter() * direction}, 0);
    if (hit && hit->front) { sum += scene.materials[scene.objects[hit->object].material[0]].emission / static_cast<double>(rays); }
  }
  return sum;
}

}  // namespace

TEST_CASE("direct light: lamps that later surfaces in their plane cover give the light that rays find", "[direct]") {
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 0, 0};
  for (int i = 0; i < 40; ++i) {
    const Scene scene = covered_lamp(random);
    auto prepared = std::move(*radiosity::prepare(scene).prepared);
    std::vector<Color> emission;
    for (const radiosity::InputSurface& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
    const radiosity::DirectLight light{prepared.objects, prepared.surfaces, emission, {64, 1.0}};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 at{1.6 * random.uniform() - 0.8, 1.6 * random.uniform() - 0.8, 0.0}, n{0, 0, 1};
      const glm::dvec3 x = (at - prepared.frame.centre) * prepared.frame.scale;
      const std::array<glm::dvec3, 4> contour{x, x, x, x};
      radiosity::LitRegion region{light, {contour, 0, 0.0}, n};
      constexpr std::uint32_t rays = 2048;
      const double found = region.irradiance(x, n).x,
                   met = by_rays(scene, prepared, x, seed + static_cast<std::uint64_t>(3 * i + k), rays).x;
      CAPTURE(i, k, found, met);
      // Four standard errors of random rays, and a part in thirty where segments to 256 points of a lamp decide (curved_lamps_test).
      CHECK(std::abs(found - met) <= 4.0 * std::sqrt(std::max(met, 1.0 / rays) / rays) + met / 30.0);
    }
  }
}

// Lamps like books on a shelf, with a plate across each gap between two of them, and so many that their sheets are taken together and have
// few samples each: from the floor of a gap hardly a sample tells of the part that is near and seen, and that part is most of the light.
// Some 60 % of all light was lost.
TEST_CASE("direct light: the floor of a narrow gap between two of many lamps, below a plate", "[direct]") {
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 1, 0};
  const auto in = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  double off = 0.0, all = 0.0;
  for (int i = 0; i < 4; ++i) {
    Scene scene{{{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.5}, Color{1.0}}}, {scenes::square("floor", {0, 0, 0}, 4.0, true)}};
    std::vector<std::array<double, 2>> gaps;
    double at = -2.0;
    for (int k = 0; k < 12; ++k) {
      const double to = at + in(0.05, 0.3), gap = in(0.01, 0.1);
      scene.objects.push_back(scenes::object("lamp" + std::to_string(k), scenes::box({at, 0, 0}, {to, in(0.3, 0.6), in(0.3, 0.8)}), 1));
      const double plate = in(0.5, 1.5) * gap;
      scene.objects.push_back(scenes::object("plate" + std::to_string(k), scenes::box({to, 0, plate}, {to + gap, 0.3, plate + 0.01})));
      gaps.push_back({to, to + gap});
      at = to + gap;
    }
    auto prepared = std::move(*radiosity::prepare(scene).prepared);
    std::vector<Color> emission;
    for (const radiosity::InputSurface& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
    const radiosity::DirectLight light{prepared.objects, prepared.surfaces, emission, {.most_surrounding = 1.0, .bodies = true}};
    for (std::size_t k = 0; k + 1 < gaps.size(); ++k) {
      const glm::dvec3 n{0, 0, 1}, place{in(gaps[k][0], gaps[k][1]), in(0.02, 0.25), 0.0};
      const glm::dvec3 x = (place - prepared.frame.centre) * prepared.frame.scale;
      const std::array<glm::dvec3, 4> contour{x, x, x, x};
      radiosity::LitRegion region{light, {contour, 0, 0.0}, n};
      const double found = region.irradiance(x, n).x, met = by_rays(scene, prepared, x, seed + k, 1024).x;
      off += (found - met) * (found - met);
      all += met * met;
    }
  }
  // Some 12 %: parts of a 48th of a lamp's light are seen or not as their middles are, and what is below 2 % of all is not cut.
  CHECK(std::sqrt(off / all) < 0.3);
}
