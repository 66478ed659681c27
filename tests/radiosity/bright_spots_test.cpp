// SPDX-License-Identifier: MIT

// Indirect light of small bright spots, as pictures gather it: no noisier than other light, and unbiased.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/sphere.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/near_light.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A floor of side 2 under a ceiling of side 8 that reflects 1 W/m2 per channel, and before this a small spot, a square or a sphere, that
// sends to the floor's middle about as much light as the whole ceiling. What the spot hides is ceiling: the irradiance has a closed form.
struct SpotRoom {
  radiosity::Scene scene;
  bool round = false;
  double half = 0.0, radiosity = 0.0;  // side of the square or diameter of the sphere, halved
  glm::dvec3 middle{0.0};

  SpotRoom(std::uint64_t seed, bool sphere) : round{sphere} {
    radiosity::Random random{seed, 0};
    half = 0.01 * std::pow(4.0, random.uniform());
    middle = {random.uniform() - 0.5, random.uniform() - 0.5, 0.8};
    const double area = round ? std::numbers::pi * half * half : 4.0 * half * half;
    radiosity = std::numbers::pi * 0.64 / area * (0.5 + random.uniform());
    scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    scene.objects = {
        scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::square("ceiling", {0, 0, 1}, 4.0, false),
        round ? scenes::object("spot", raycast::Sphere::make(middle, half).object, 0) : scenes::square("spot", middle, half, false),
        scenes::square("lamp", {0, 0, 2}, 0.5, true, 1)};  // behind the ceiling: it is seen from nowhere
  }

  [[nodiscard]] double form_factor(const glm::dvec3& x, const glm::dvec3& centre, double r) const {
    const std::vector<glm::dvec3> corners{centre + glm::dvec3{-r, r, 0}, centre + glm::dvec3{r, r, 0}, centre + glm::dvec3{r, -r, 0},
                                          centre + glm::dvec3{-r, -r, 0}};
    return radiosity::point_to_polygon(x, {0, 0, 1}, corners);
  }
  [[nodiscard]] double irradiance(const glm::dvec3& x) const {
    const glm::dvec3 d = middle - x;
    const double square = glm::dot(d, d);
    const double spot = round ? d.z / std::sqrt(square) * half * half / square : form_factor(x, middle, half);
    return form_factor(x, {0, 0, 1}, 4.0) + (radiosity - 1.0) * spot;
  }
  // A solution of the room, in which floor and ceiling, spot and lamp have the colours that the room says.
  [[nodiscard]] radiosity::Solution solution() const {
    radiosity::Options options;
    options.epsilon = 0.02;
    options.audit_points = 0;
    radiosity::Solution solution = scenes::solved(scene, options);
    for (const radiosity::MeshFace& face : solution.mesh.faces) {
      const double b = face.surface == 0 ? 0.5 : face.surface == 2 ? radiosity : 1.0;
      for (std::uint32_t c = 0; c < face.corner_count; ++c) {
        solution.mesh.corners[face.first_corner + c].radiosity = radiosity::Color{b};
      }
    }
    return solution;
  }
};

}  // namespace

// Each point is gathered until its standard error is 3 %, so that of a difference is sqrt(2) times that; the standard error is itself known
// to a half. By even rays alone, a spot of form factor F that sends half of the light makes 1024 of them off by 1 / sqrt(4096 F): 50 % at
// F = .001, where 8.5 % are allowed.
TEST_CASE("a small bright spot: gathered light differs from point to point as the true light does", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  const SpotRoom room{seed, false};
  CAPTURE(seed, room.half, room.radiosity);
  const radiosity::Solution solution = room.solution();
  const radiosity::FinalGather light{room.scene, solution.mesh, solution.frame};
  radiosity::Random random{seed, 1};
  constexpr int pairs = 64;
  double squares = 0.0;
  const auto gathered = [&](const glm::dvec3& x) {
    const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
    const auto& rays = radiosity::gather_rays;
    return light.indirect(place, rays.least, rays.most, rays.error, random.bits()).irradiance.x;
  };
  for (int i = 0; i < pairs; ++i) {
    const glm::dvec3 x{1.6 * random.uniform() - 0.8, 1.6 * random.uniform() - 0.8, 0.0};
    const glm::dvec3 y = x + glm::dvec3{0.02 * random.uniform(), 0.02 * random.uniform(), 0.0};
    const double off = (gathered(x) - gathered(y)) - (room.irradiance(x) - room.irradiance(y));
    squares += off * off / (room.irradiance(x) * room.irradiance(x)) / pairs;
  }
  CHECK(std::sqrt(squares) < 2.0 * std::sqrt(2.0) * radiosity::gather_rays.error);
}

// Over independent families of rays the mean is off by at most five of its standard errors, and .3 %: the mesh of a sphere stands for its
// points by chords, so the density of what is aimed at is known to the square of their angle.
TEST_CASE("light of bright spots has no bias, flat or round", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  for (const bool round : {false, true}) {
    const SpotRoom room{seed, round};
    CAPTURE(seed, round, room.half, room.radiosity);
    const radiosity::Solution solution = room.solution();
    const radiosity::FinalGather light{room.scene, solution.mesh, solution.frame};
    const glm::dvec3 x{0.3, -0.2, 0.0};
    const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
    constexpr int families = 64;
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t key = 0; key < families; ++key) {
      const double value = light.indirect(place, 1024, 1024, 0.0, radiosity::scramble(seed) + key).irradiance.x;
      sum += value / families;
      squares += value * value / families;
    }
    const double standard_error = std::sqrt((squares - sum * sum) / (families - 1));
    CHECK(std::abs(sum - room.irradiance(x)) < 5.0 * standard_error + 0.003 * room.irradiance(x));
  }
}

// A path from the floor that ends by chance on the spot is rare and bright; one that is aimed at it is not. Both ways have the same mean,
// what the floor reflects there, within five of its standard errors and .3 %, as above; the aimed one has at most half of the error.
TEST_CASE("paths of near light find bright spots without bias, and with less noise than by chance", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  const SpotRoom room{seed, false};
  CAPTURE(seed, room.half, room.radiosity);
  const radiosity::Solution solution = room.solution();
  const radiosity::Lookup lookup{room.scene, solution.mesh, solution.frame};
  std::vector<radiosity::Material> materials;
  std::vector<radiosity::Color> emission;
  for (const radiosity::InputSurface& input : radiosity::surfaces(room.scene)) {
    materials.push_back(room.scene.materials[input.material]);
    emission.push_back(materials.back().emission);
  }
  std::vector<radiosity::Surface> boundaries;
  for (std::uint32_t o = 0; o < lookup.objects().size(); ++o) {
    boundaries.push_back(*radiosity::make_surface(lookup.objects().object(o), lookup.surface(o, 0)).surface);
  }
  const radiosity::DirectLight direct{lookup.objects(), boundaries, emission};
  const radiosity::BrightSpots spots{lookup, direct, emission};
  REQUIRE_FALSE(spots.empty());
  const radiosity::NearLight near{lookup, direct, materials};
  const glm::dvec3 x{0.3, -0.2, 0.0};
  const radiosity::NearLight::Seen seen{{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0}, radiosity::Color{1.0}};
  const radiosity::BrightSpots::From from{spots, seen.at.point.position};
  double error[2] = {0.0, 0.0};
  for (const bool aimed : {false, true}) {
    constexpr int families = 256;
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t key = 0; key < families; ++key) {
      const double value = near.light({&seen, 1}, 64, radiosity::scramble(seed) + key, aimed ? &from : nullptr).light.x;
      sum += value / families;
      squares += value * value / families;
    }
    error[aimed] = std::sqrt((squares - sum * sum) / (families - 1));
    const double truth = 0.5 * room.irradiance(x);
    CHECK(std::abs(sum - truth) < 5.0 * error[aimed] + 0.003 * truth);
  }
  CHECK(error[1] < 0.5 * error[0]);
}
