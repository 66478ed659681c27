// SPDX-License-Identifier: MIT
// Bright spots on objects for which meshes stand in where rays are cast: rays are aimed at the object, and meet the mesh beside it.
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "families.hpp"
#include "scenes.hpp"
#include "shaded_lamp.hpp"
#include "solved.hpp"

// A floor under a ceiling of side 8 that reflects 1 W/m2 per channel, and before this a small hollow ball that sends about as much light:
// the irradiance has a closed form. Over independent families of rays the mean is off by at most five of its standard errors, and by what
// the mesh is off: .04 % of the ball's diameter, .16 % of its area, and .3 % as with any curved spot. Even rays alone, n of which meet the
// ball with the probability of its form factor F, have the standard error radiosity sqrt(F / n); aimed ones leave at most half of that.
TEST_CASE("light of a bright spot for which a mesh stands in has no bias", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  const double half = 0.02 + 0.06 * random.uniform();
  const glm::dvec3 middle{random.uniform() - 0.5, random.uniform() - 0.5, 0.8};
  const double radiosity = 0.64 / (half * half);
  CAPTURE(seed, half, radiosity);
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  raycast::CsgNode ball{{}, "ball", raycast::CsgOperation::subtract, {}, {}};
  for (const double r : {half, 0.5 * half}) { ball.parts.push_back({raycast::Sphere::make(middle, r).object, "part", {}, {}, {}}); }
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::square("ceiling", {0, 0, 1}, 4.0, false),
                   scenes::object("spot", raycast::Csg::make(ball).object, 0),
                   scenes::square("lamp", {0, 0, 2}, 0.5, true, 1)};  // behind the ceiling: it is seen from nowhere
  radiosity::Options options{.epsilon = 0.02, .audit_points = 0};
  radiosity::Solution solution = scenes::solved(scene, options);
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    const double b = face.surface == 0 ? 0.5 : face.surface == 2 ? radiosity : 1.0;
    for (std::uint32_t c = 0; c < face.corner_count; ++c) { solution.mesh.corners[face.first_corner + c].radiosity = radiosity::Color{b}; }
  }
  const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
  REQUIRE(light.direct().lift(2) > 0.0);
  const glm::dvec3 x{0.3, -0.2, 0.0}, d = middle - x;
  const double square = glm::dot(d, d), spot = d.z / std::sqrt(square) * half * half / square;
  const std::vector<glm::dvec3> ceiling{{-4, 4, 1}, {4, 4, 1}, {4, -4, 1}, {-4, -4, 1}};
  const double truth = radiosity::point_to_polygon(x, {0, 0, 1}, ceiling) + (radiosity - 1.0) * spot;
  const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
  const auto [mean, standard_error] = scenes::gathered(light, place, seed);
  CAPTURE(mean, truth);
  CHECK(std::abs(mean - truth) < 5.0 * standard_error + (0.003 + 0.0016) * truth);
  CHECK(standard_error < 0.5 * radiosity * std::sqrt(spot / (static_cast<double>(scenes::rays_of_family) * scenes::families)));
}

// To the walls the light of a shade's inside comes below its rim alone, so a ray aimed at it mostly meets the outside. Photons that the
// inside sends out tell which part of it a point of the wall sees. Where they began behind the mesh that stands in for the shade, none got
// out, and what points differed by was 9 to 15 % in place of 1.5 %.
TEST_CASE("light from within a shade for which a mesh stands in differs from point to point no more than is asked for",
          "[picture][accuracy]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(2, random(1, 1'000'000))));
  const radiosity::Scene scene = scenes::shaded_lamp(seed);
  radiosity::Random random{seed, 1};
  CAPTURE(seed);
  radiosity::Options options{.epsilon = 0.02, .audit_points = 0};
  const radiosity::Solution solution = scenes::solved(scene, options);
  const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
  REQUIRE(light.direct().lift(1) > 0.0);
  constexpr int points = 24, families = 8;
  double squares = 0.0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 x{4.0, 0.5 + 3.0 * random.uniform(), 0.2 + 1.4 * random.uniform()};
    const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {-1, 0, 0}}, 0, 1};  // the sheet x1
    double sum = 0.0, own = 0.0;
    for (int k = 0; k < families; ++k) {
      const double found = light.indirect(place, radiosity::gather_rays, random.bits()).irradiance.x;
      sum += found / families;
      own += found * found / families;
    }
    squares += (own / (sum * sum) - 1.0) * families / (families - 1.0) / points;
  }
  CAPTURE(std::sqrt(squares));
  CHECK(std::sqrt(squares) < radiosity::gather_rays.error);
}
