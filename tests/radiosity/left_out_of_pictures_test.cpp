// SPDX-License-Identifier: MIT
// What a picture need not look at: copies of an object, and indirect light where there is none.
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A floor, things on it, and a lamp.
radiosity::Scene world(const std::vector<radiosity::SceneObject>& things, double reflectance) {
  radiosity::Scene scene;
  scene.materials = {{"plain", radiosity::Color{reflectance}, radiosity::Color{0.0}},
                     {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 2.0, true)};
  scene.objects.insert(scene.objects.end(), things.begin(), things.end());
  scene.objects.push_back(scenes::square("lamp", {0, 0, 2}, 0.5, false, 1));
  return scene;
}

radiosity::Solution coarse(const radiosity::Scene& scene) {
  const radiosity::Options options{.epsilon = 0.1, .min_area = 1e-2, .audit_points = 0};
  return scenes::solved(scene, options);
}

// One of each kind that is asked for in a way of its own: flat, round, and a solid for which a mesh stands in.
std::vector<radiosity::SceneObject> kinds() {
  raycast::CsgNode hollow{{}, "hollow", raycast::CsgOperation::subtract, {}, {}};
  hollow.parts.push_back({raycast::Sphere::make({1, 0, 0.5}, 0.3).object, "outer", {}, {}, {}});
  hollow.parts.push_back({raycast::Sphere::make({1, 0, 0.5}, 0.2).object, "inner", {}, {}, {}});
  return {scenes::object("box", scenes::box({-1.2, -0.3, 0.2}, {-0.8, 0.3, 0.7})),
          scenes::object("ball", raycast::Sphere::make({0, 0.9, 0.5}, 0.3).object),
          scenes::object("hollow", raycast::Csg::make(hollow).object)};
}

}  // namespace

TEST_CASE("no ray of a picture meets an object of which a copy comes later", "[picture]") {
  constexpr std::uint64_t seed = 21;
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  std::vector<radiosity::SceneObject> things;
  constexpr std::uint32_t copies = 4;
  for (std::uint32_t k = 0; k < copies; ++k) {
    for (const radiosity::SceneObject& thing : kinds()) { things.push_back(thing); }
  }
  const radiosity::Scene scene = world(things, 0.5);
  const radiosity::Solution solution = coarse(scene);
  const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
  REQUIRE(light.direct().lift(3) == 0.0);  // of a copy no stand-in is made
  REQUIRE(light.direct().lift(3 * copies) > 0.0);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 from{4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0, 1.5};
    const glm::dvec3 to{4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0, 0.0};
    const raycast::Segment ray{(from - solution.frame.centre) * solution.frame.scale, to - from};
    for (const raycast::Scene* objects : {&light.objects(), &light.direct().objects()}) {
      const auto hit = objects->closest(ray);
      REQUIRE(hit);
      const std::uint32_t object = objects == &light.objects() ? hit->object : light.direct().whole(hit->object);
      CAPTURE(i, object);
      REQUIRE((object == 0 || object > 3 * (copies - 1)));
      met += object != 0 ? 1 : 0;
    }
  }
  REQUIRE(met > 20);
}

TEST_CASE("where nothing but lamps shines and nothing reflects, all light of a picture is direct", "[picture]") {
  for (const double reflectance : {0.0, 0.5}) {
    radiosity::Scene scene = world(kinds(), reflectance);
    const radiosity::Solution solution = coarse(scene);
    const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
    CHECK(light.direct_alone() == (reflectance == 0.0));
  }
  // Without any lamp, too.
  radiosity::Scene dark = world(kinds(), 0.5);
  dark.materials[1].emission = radiosity::Color{0.0};
  const radiosity::Solution solution = coarse(dark);
  CHECK(radiosity::FinalGather{dark, solution.mesh, solution.frame}.direct_alone());
}
