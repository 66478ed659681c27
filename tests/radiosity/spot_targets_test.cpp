// SPDX-License-Identifier: MIT

// The points of bright spots at which rays are aimed: how often each is chosen, and the light that is found there.

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// Spots of any brightness above a dark floor; the light varies linearly over each of them.
struct Spots {
  static constexpr std::uint32_t count = 12;
  radiosity::Scene scene;
  radiosity::Solution solution;

  explicit Spots(radiosity::Random& random) {
    scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    scene.objects = {scenes::square("floor", {0, 0, 0}, 2.0, true), scenes::square("lamp", {0, 0, 3}, 0.5, true, 1)};
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec3 middle{0.25 * i - 1.5, 2.0 * random.uniform() - 1.0, 0.5 + random.uniform()};
      scene.objects.push_back(scenes::square("spot", middle, 0.02 * std::pow(4.0, random.uniform()), false));
    }
    solution = scenes::solved(scene, {.epsilon = 0.02, .audit_points = 0});
    for (const radiosity::MeshFace& face : solution.mesh.faces) {
      if (face.surface == 1) { continue; }  // the lamp
      const double bright = 5.0 * face.surface;
      for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
        const glm::dvec3& at = solution.mesh.positions[solution.mesh.corners[c].vertex];
        solution.mesh.corners[c].radiosity = bright * radiosity::Color{2.0 + at.x, 2.0 + at.y, 4.0 + at.x - at.y};
      }
    }
  }
};

double area(const radiosity::ChordTriangle& triangle) {
  const auto& [a, b, c] = triangle.position;
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

TEST_CASE("targets of bright spots: the light of each is what the lookup finds there, and each is chosen as often as its density says") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  const Spots room{random};
  const radiosity::Lookup lookup{room.scene, room.solution.mesh, room.solution.frame};
  std::vector<radiosity::Color> emission;
  for (const radiosity::InputSurface& input : radiosity::surfaces(room.scene)) {
    emission.push_back(room.scene.materials[input.material].emission);
  }
  const radiosity::DirectLight direct{lookup.objects(), scenes::boundaries(lookup.objects()), emission};
  const radiosity::BrightSpots spots{lookup, direct, emission};
  REQUIRE_FALSE(spots.empty());
  const raycast::SurfacePoint place{{0.1, 0.1, lookup.objects().bounds().lo.z}, {0, 0, 1}};
  const radiosity::BrightSpots::From from{spots, place};

  constexpr int draws = 20'000;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> chosen;  // how often, by input surface and triangle
  for (int i = 0; i < draws; ++i) {
    const auto target = from.choose({random.uniform(), random.uniform(), random.uniform(), 0.5});
    const auto known = spots.found(target), searched = lookup.find(target.at);
    REQUIRE(known);
    REQUIRE(searched);
    // Both interpolate a linear function: on an edge another triangle gives the same light, to the rounding of the weights.
    CHECK(glm::length(known->radiosity - searched->radiosity) <= 1e-9 * glm::length(searched->radiosity));
    ++chosen[{lookup.surface(target.at.object, target.at.sheet), known->triangle}];
  }

  double all = 0.0, chi_square = 0.0, cells = 0.0;
  int counted = 0;
  for (std::uint32_t surface = 0; surface < emission.size(); ++surface) {
    for (std::uint32_t k = 0; k < lookup.triangle_count(surface); ++k) {
      const double probability = from.density(surface, k) * area(lookup.triangle(surface, k)), expected = draws * probability;
      const auto at = chosen.find({surface, k});
      const int count = at != chosen.end() ? at->second : 0;
      all += probability;
      counted += count;
      if (!(expected > 0.0)) { CHECK(count == 0); }
      if (!(expected > 5.0)) { continue; }  // rarer ones are not distributed normally
      chi_square += (count - expected) * (count - expected) / expected;
      cells += 1.0;
    }
  }
  CHECK(all == test::Approx(1.0).epsilon(1e-9));
  CHECK(counted == draws);
  REQUIRE(cells > 5.0);
  CHECK(chi_square < cells + 6.0 * std::sqrt(2.0 * cells));  // its mean is at most `cells`, its variance twice that
}
