// SPDX-License-Identifier: MIT

// Indirect light of small bright spots, as pictures gather it: no noisier than other light, and unbiased.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/near_light.hpp>
#include <radiosity/picture/spot_photons.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "families.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A floor of side 2 under a ceiling of side 8 that reflects 1 W/m2 per channel, and before this a small spot, a square or a sphere, that
// sends to the floor's middle about as much light as the whole ceiling. What the spot hides is ceiling: the irradiance has a closed form.
// A spot may be larger by a factor, and send less.
struct SpotRoom {
  radiosity::Scene scene;
  bool round = false;
  double half = 0.0, radiosity = 0.0;  // side of the square or diameter of the sphere, halved
  glm::dvec3 middle{0.0};

  SpotRoom(std::uint64_t seed, bool sphere, double size = 1.0, double power = 1.0) : round{sphere} {
    radiosity::Random random{seed, 0};
    half = 0.01 * size * std::pow(4.0, random.uniform());
    middle = {random.uniform() - 0.5, random.uniform() - 0.5, 0.8};
    const double area = round ? std::numbers::pi * half * half : 4.0 * half * half;
    radiosity = power * std::numbers::pi * 0.64 / area * (0.5 + random.uniform());
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
    radiosity::Options options{.epsilon = 0.02, .audit_points = 0};
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

// Above a screen with a hole hang 49 small bright spots; through the hole a floor sees one of them, or a part of it. The screen sends
// 1 W/m2, the spot about as much light as all of the screen. What is seen through the hole is a rectangle in the plane of the spots, so the
// irradiance has a closed form.
struct HiddenSpots {
  static constexpr double screen = 0.6, level = 0.8, half = 0.02, hole = 0.05, wide = 4.0;  // heights and half sides
  radiosity::Scene scene;
  glm::dvec3 foot{0.0};  // below the spot that is seen
  double radiosity = 0.0;

  struct Rectangle {
    double x0, y0, x1, y1;
  };
  static std::vector<glm::dvec3> corners(const Rectangle& r, double z) {  // seen from below
    return {{r.x0, r.y1, z}, {r.x1, r.y1, z}, {r.x1, r.y0, z}, {r.x0, r.y0, z}};
  }

  explicit HiddenSpots(std::uint64_t seed) {
    radiosity::Random random{seed, 2};
    radiosity = std::numbers::pi * level * level / (4.0 * half * half) * (0.5 + random.uniform());
    const auto pick = [&] { return 0.25 * (std::floor(7.0 * random.uniform()) - 3.0); };
    foot.x = pick();
    foot.y = pick();
    scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    const auto add = [&](const char* name, const Rectangle& r, double z) {
      scene.objects.push_back(scenes::object(name, raycast::Polygon::make(corners(r, z)).object, 0));
    };
    scene.objects = {scenes::square("floor", {0, 0, 0}, 1.5, true)};
    const double x0 = foot.x - hole, x1 = foot.x + hole, y0 = foot.y - hole, y1 = foot.y + hole;
    add("left", {-wide, -wide, x0, wide}, screen);
    add("right", {x1, -wide, wide, wide}, screen);
    add("front", {x0, -wide, x1, y0}, screen);
    add("back", {x0, y1, x1, wide}, screen);
    for (int i = -3; i <= 3; ++i) {
      for (int k = -3; k <= 3; ++k) { add("spot", {0.25 * i - half, 0.25 * k - half, 0.25 * i + half, 0.25 * k + half}, level); }
    }
    scene.objects.push_back(scenes::square("lamp", {0, 0, 2}, 0.5, true, 1));  // looks away: it is seen from nowhere
  }

  [[nodiscard]] double irradiance(const glm::dvec3& x) const {
    const auto factor = [&](const Rectangle& r, double z) {
      return r.x0 < r.x1 && r.y0 < r.y1 ? radiosity::point_to_polygon(x, {0, 0, 1}, corners(r, z)) : 0.0;
    };
    const double scale = level / screen;  // of the hole, from x to the plane of the spots
    const auto through = [&](double at, double centre, double side) { return at + scale * (centre + side - at); };
    const double rest =
        factor({-wide, -wide, wide, wide}, screen) - factor({foot.x - hole, foot.y - hole, foot.x + hole, foot.y + hole}, screen);
    double spots = 0.0;
    for (int i = -3; i <= 3; ++i) {
      for (int k = -3; k <= 3; ++k) {
        spots += factor({std::max(0.25 * i - half, through(x.x, foot.x, -hole)), std::max(0.25 * k - half, through(x.y, foot.y, -hole)),
                         std::min(0.25 * i + half, through(x.x, foot.x, hole)), std::min(0.25 * k + half, through(x.y, foot.y, hole))},
                        level);
      }
    }
    return rest + radiosity * spots;
  }

  [[nodiscard]] radiosity::Solution solution() const {
    radiosity::Options options{.epsilon = 0.02, .audit_points = 0};
    radiosity::Solution solution = scenes::solved(scene, options);
    for (const radiosity::MeshFace& face : solution.mesh.faces) {
      const double b = face.surface == 0 ? 0.5 : face.surface < 5 ? 1.0 : face.surface < 54 ? radiosity : 1.0;
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
    return light.indirect(place, radiosity::gather_rays, random.bits()).irradiance.x;
  };
  for (int i = 0; i < pairs; ++i) {
    const glm::dvec3 x{1.6 * random.uniform() - 0.8, 1.6 * random.uniform() - 0.8, 0.0};
    const glm::dvec3 y = x + glm::dvec3{0.02 * random.uniform(), 0.02 * random.uniform(), 0.0};
    const double off = (gathered(x) - gathered(y)) - (room.irradiance(x) - room.irradiance(y));
    squares += off * off / (room.irradiance(x) * room.irradiance(x)) / pairs;
  }
  CHECK(std::sqrt(squares) < 2.0 * std::sqrt(2.0) * radiosity::gather_rays.error);
}

// A spot with a form factor of .01 to .2 that sends 10 to 60 % of the light spreads even rays by half to all of the light. Those that miss
// it agree with each other, and a point that stops by their spread is too dark: by 6 % the darkest of 64. Rays that are aimed at the spot
// leave the noise of the even ceiling, which is below three tenths of what is allowed.
TEST_CASE("a faint bright spot: no gathered point is too dark because its rays agree", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(1, random(1, 1'000'000))));
  constexpr int rooms = 10, places = 64;
  double squares = 0.0;
  for (std::uint64_t room_seed = seed; room_seed < seed + rooms; ++room_seed) {
    const SpotRoom room{room_seed, false, 4.0, 0.35};
    const radiosity::Solution solution = room.solution();
    const radiosity::FinalGather light{room.scene, solution.mesh, solution.frame};
    radiosity::Random random{room_seed, 1};
    for (int i = 0; i < places; ++i) {
      const glm::dvec3 x{1.6 * random.uniform() - 0.8, 1.6 * random.uniform() - 0.8, 0.0};
      const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
      const double off = light.indirect(place, radiosity::gather_rays, random.bits()).irradiance.x / room.irradiance(x) - 1.0;
      squares += off * off / (rooms * places);
    }
  }
  CAPTURE(seed);
  CHECK(std::sqrt(squares) < 0.3 * radiosity::gather_rays.error);
}

// Light of a spot near by changes within its distance, however far the rest of what is seen: points of gathered light must lie that dense.
TEST_CASE("where most light comes from near by, the nearness of light tells it", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(8, random(1, 1'000'000))));
  SpotRoom room{seed, false};
  radiosity::Random random{seed, 3};
  const glm::dvec3 x{0.0, 0.0, 0.0};
  room.half = 0.01;
  room.middle = {0.1 * random.uniform() - 0.05, 0.1 * random.uniform() - 0.05, 0.03 + 0.05 * random.uniform()};
  room.radiosity = 4.0 / room.form_factor(x, room.middle, room.half);  // four times the light of the ceiling
  room.scene.objects[2] = scenes::square("spot", room.middle, room.half, false);
  CAPTURE(seed, room.middle.x, room.middle.y, room.middle.z);
  const radiosity::Solution solution = room.solution();
  const radiosity::FinalGather light{room.scene, solution.mesh, solution.frame};
  const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
  const double distance = solution.frame.scale * glm::length(room.middle - x);
  CHECK(light.indirect(place, radiosity::gather_rays, random.bits()).nearness_of_light > 0.5 / distance);
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
    const auto [mean, standard_error] = scenes::gathered(light, place, seed);
    CHECK(std::abs(mean - room.irradiance(x)) < 5.0 * standard_error + 0.003 * room.irradiance(x));
  }
}

// A path from the floor that ends by chance on the spot is rare and bright; one that is aimed at it is not. Both ways have the same mean,
// what the floor reflects there, within five of its standard errors and .3 %, as above; the aimed one has at most half of the error.
// By chance a path ends on the spot with the probability F of its form factor, in 16384 paths half a time to fifty times: too seldom to
// tell from the paths themselves how far off they are. So that standard error is the one of n independent paths, radiosity sqrt(F (1 - F) /
// n).
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
  const radiosity::DirectLight direct{lookup.objects(), scenes::boundaries(lookup.objects()), emission};
  const radiosity::BrightSpots spots{lookup, direct, emission};
  REQUIRE_FALSE(spots.empty());
  const radiosity::PhotonGrid no_photons;
  const radiosity::NearLight near{lookup, direct, materials, no_photons};
  const glm::dvec3 x{0.3, -0.2, 0.0};
  const radiosity::NearLight::Seen seen{{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0}, radiosity::Color{1.0}};
  const radiosity::BrightSpots::From from{spots, seen.at.position};
  constexpr int families = 256, paths = 64;
  const double f = room.form_factor(x, room.middle, room.half);
  double error[2] = {0.5 * room.radiosity * std::sqrt(f * (1.0 - f) / (families * paths)), 0.0};
  for (const bool aimed : {false, true}) {
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t key = 0; key < families; ++key) {
      const double value = near.light({&seen, 1}, paths, radiosity::scramble(seed) + key, aimed ? &from : nullptr).light.x;
      sum += value / families;
      squares += value * value / families;
    }
    if (aimed) { error[1] = std::sqrt((squares - sum * sum) / (families - 1)); }
    const double truth = 0.5 * room.irradiance(x);
    CHECK(std::abs(sum - truth) < 5.0 * error[aimed] + 0.003 * truth);
  }
  CHECK(error[1] < 0.5 * error[0]);
}

// As for a spot that nothing hides, above. An aimed ray that knows nothing of the screen meets one spot in 49, and of 1024 even rays one or
// two: 80 % off.
TEST_CASE("a bright spot that is seen through a hole: gathered light differs from point to point as the true light does", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  const HiddenSpots room{seed};
  CAPTURE(seed, room.radiosity);
  const radiosity::Solution solution = room.solution();
  const radiosity::FinalGather light{room.scene, solution.mesh, solution.frame};
  radiosity::Random random{seed, 1};
  constexpr int points = 128;
  double squares = 0.0, sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 x = room.foot + glm::dvec3{0.3 * random.uniform() - 0.15, 0.3 * random.uniform() - 0.15, 0.0};
    const radiosity::FinalGather::Place place{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0};
    const double off = light.indirect(place, radiosity::gather_rays, random.bits()).irradiance.x / room.irradiance(x) - 1.0;
    squares += off * off / points;
    sum += off / points;
  }
  CHECK(std::sqrt(squares) < 2.0 * radiosity::gather_rays.error);
  CHECK(std::abs(sum) < 5.0 * radiosity::gather_rays.error / std::sqrt(double{points}));  // no bias
}

// The nearest that face the same way, by looking at all of them.
TEST_CASE("photons around a point are the nearest ones that face its way", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  const auto place = [&] { return glm::dvec3{random.uniform(), random.uniform(), random.uniform()}; };
  std::vector<radiosity::SpotPhotons::Photon> all(2000);
  for (auto& photon : all) {
    photon.position = place();
    photon.normal = radiosity::cosine_direction({0, 0, random.uniform() < 0.5 ? 1 : -1}, random.uniform(), random.uniform());
  }
  const double reach = 0.25;
  const radiosity::SpotPhotons photons{all, reach};
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 x = place(), up{0, 0, 1};
    const bool any_way = i % 2 == 0;
    std::vector<double> expected, got;
    for (const auto& photon : all) {
      const double distance = glm::length(photon.position - x);
      if (distance < reach && (any_way || glm::dot(photon.normal, up) > 0.7)) { expected.push_back(distance); }
    }
    std::sort(expected.begin(), expected.end());
    if (expected.size() > photons.most_found) { expected.resize(photons.most_found); }
    const auto found = photons.around(x, any_way ? nullptr : &up);
    for (const std::uint32_t k : found.photons) { got.push_back(glm::length(photons[k].position - x)); }
    std::sort(got.begin(), got.end());
    CHECK(got == expected);
    CHECK(found.radius == test::Approx(expected.size() < photons.most_found ? reach : expected.back()));
  }
}
