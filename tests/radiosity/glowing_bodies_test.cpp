// SPDX-License-Identifier: MIT

// Bodies of many faces that shine little brighter than all do in the mean: pictures find their light by rays, like the solution.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/mesh.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

radiosity::SceneObject mesh_of(const std::string& name, const soup::Soup& polygons) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::size_t f = 0; f < polygons.count(); ++f) {
    faces.emplace_back(polygons.corners.begin() + polygons.first[f], polygons.corners.begin() + polygons.first[f + 1]);
  }
  return scenes::object(name, raycast::Mesh::make(polygons.positions, faces).object);
}

// A closed room and a ring of triangles in it, all of which shine alike; with a lamp `brightness` times as bright, if that is not 0.
radiosity::Scene glowing_room(radiosity::Random& random, double reflectance, double brightness) {
  soup::Soup ring;
  soup::add_torus(ring, 24, 14);
  for (glm::dvec3& p : ring.positions) { p += glm::dvec3(2.0 + random.uniform(), 2.0 + random.uniform(), 1.0); }
  radiosity::Scene scene;
  scene.materials = {{"glow", radiosity::Color{reflectance}, radiosity::Color{1.0}},
                     {"lamp", radiosity::Color{0.0}, radiosity::Color{brightness}}};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {5, 5, 3}), 0, true), mesh_of("ring", ring)};
  if (brightness > 0.0) { scene.objects.push_back(scenes::plate("lamp", {{2, 2, 2.9}, {2, 3, 2.9}, {3, 3, 2.9}, {3, 2, 2.9}}, 1)); }
  return scene;
}

}  // namespace

TEST_CASE("what shines like all else is no lamp of a picture, and the light gathered of it is that of a furnace", "[picture]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 5};
  const double reflectance = 0.2 + 0.6 * random.uniform();
  const radiosity::Scene scene = glowing_room(random, reflectance, 0.0);
  const radiosity::Solution solution = scenes::solved(scene, {.epsilon = 0.05, .min_area = 1e-3, .audit_points = 0});
  const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
  CHECK(light.direct().lamps().empty());
  const double everywhere = 1.0 / (1.0 - reflectance);
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 x{5.0 * random.uniform(), 5.0 * random.uniform(), 0.0};
    const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 4};
    CHECK(std::abs(light.indirect(place, radiosity::gather_rays, random.bits()).irradiance.x / everywhere - 1.0) < 0.01);
  }
  const radiosity::Scene with_lamp = glowing_room(random, reflectance, 50.0);
  const radiosity::Solution lit = scenes::solved(with_lamp, {.epsilon = 0.05, .min_area = 1e-3, .audit_points = 0});
  CHECK(radiosity::FinalGather{with_lamp, lit.mesh, lit.frame}.direct().lamps().size() == 1);
  // A small bulb of many faces is a lamp, though it is little brighter than the mean: rays hardly meet it.
  soup::Soup bulb;
  soup::add_torus(bulb, 12, 6, 0.02, 0.01);
  for (glm::dvec3& p : bulb.positions) { p += glm::dvec3(1.0, 1.0, 2.0); }
  radiosity::Scene with_bulb = scene;
  with_bulb.objects.push_back(mesh_of("bulb", bulb));
  const radiosity::Solution by_bulb = scenes::solved(with_bulb, {.epsilon = 0.05, .min_area = 1e-3, .audit_points = 0});
  CHECK_FALSE(radiosity::FinalGather{with_bulb, by_bulb.mesh, by_bulb.frame}.direct().lamps().empty());
}
