// SPDX-License-Identifier: MIT

// Stiff and extreme scenes: a right answer or a refusal that says why, never a silent wrong one. (No light, all black, a box on the floor,
// far offsets, scales by powers of two and faulty input are tested in radiosity_test.cpp and audit_test.cpp.)

#include <radiosity/radiosity.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/torus.hpp>

#include "catch.hpp"
#include "scenes.hpp"

using radiosity::Color;
using radiosity::Options;
using radiosity::Outcome;
using radiosity::Scene;
using radiosity::Solution;

namespace {

Options coarse() {
  Options options;
  options.epsilon = 0.1;
  options.min_area = 1e-3;
  options.audit_points = 0;
  options.threads = 1;
  return options;
}

Solution solved(const Scene& scene, const Options& options = coarse()) {
  Outcome outcome = radiosity::solve(scene, options);
  for (const std::string& sentence : outcome.failure.sentences) { UNSCOPED_INFO(sentence); }
  REQUIRE(outcome.solution);
  for (const Color& b : outcome.solution->radiosity) { REQUIRE((std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.z))); }
  return std::move(*outcome.solution);
}

double mean(const Solution& solution, const std::string& name) {
  for (const radiosity::SurfaceMean& s : solution.audit.surfaces) {
    if (s.name == name) { return s.radiosity.x; }
  }
  FAIL("no surface " << name);
  return 0.0;
}

radiosity::SceneObject plate(const std::string& name, std::vector<glm::dvec3> corners, std::uint32_t material = 0) {
  return scenes::object(name, scenes::polygon(std::move(corners)), material);
}
// A square of side 2 r about (x, y, z), seen from above or from below.
radiosity::SceneObject square(const std::string& name, double x, double y, double z, double r, bool up, std::uint32_t material) {
  std::vector<glm::dvec3> corners{{x - r, y - r, z}, {x + r, y - r, z}, {x + r, y + r, z}, {x - r, y + r, z}};
  if (!up) { std::reverse(corners.begin(), corners.end()); }
  return plate(name, std::move(corners), material);
}

}  // namespace

TEST_CASE("extreme: closed rooms of reflectance .99 to 1 - 1e-9 glow as they must, in at most 20 iterations") {
  for (const double loss : {1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    CAPTURE(loss);
    const Solution furnace = solved(scenes::furnace_with_things(1.0 - loss));
    CHECK(furnace.audit.iterations <= 20);
    CHECK(furnace.audit.converged);
    // In units of the area a leaf averages over B is 1 up to the rounding of sums, amplified by 1 / loss.
    for (const radiosity::MeshFace& face : furnace.mesh.faces) { REQUIRE(std::abs(face.radiosity.x - 1.0) < 1e-3); }

    Scene room = scenes::room_with_box();
    room.materials[0].reflectance = Color{1.0 - loss};
    room.materials[1].reflectance = Color{1.0 - loss};
    const Solution lit = solved(room);
    CAPTURE(lit.audit.iterations, lit.audit.residual);
    CHECK(lit.audit.iterations <= 20);
    CHECK(lit.audit.converged);
    CHECK(lit.audit.energy_balance < 1e-5);
    // As nothing is lost soon, the room fills evenly: B = emitted / (area loss), less the first bounces.
    double emitted = 0.0;
    double area = 0.0;
    for (const radiosity::SurfaceMean& s : lit.audit.surfaces) {
      emitted += s.name == "lamp" ? 5.0 * s.area : 0.0;
      area += s.area;
    }
    CHECK(mean(lit, "room.z0") * loss == test::Approx(emitted / area).epsilon(2.0 * loss + 1e-3));
  }
}

TEST_CASE("extreme: reflectance 1 in an open scene has a steady state") {
  const Solution solution = solved(scenes::two_plates(1.0));
  CHECK(solution.audit.converged);
  // All that is emitted, to both sides of every bounce, leaves in the end.
  CHECK(solution.audit.escaped == test::Approx(1.0).epsilon(1e-6));
}

TEST_CASE("extreme: reflectances and emissions out of range are refused with the name of the material") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [reflectance, emission] : {std::pair{1.0001, 0.0}, std::pair{-1e-9, 0.0}, std::pair{nan, 0.0}, std::pair{0.5, -1.0},
                                              std::pair{0.5, nan}, std::pair{0.5, std::numeric_limits<double>::infinity()}}) {
    Scene scene = scenes::two_plates(0.5);
    scene.materials[1].reflectance.y = reflectance;
    scene.materials[1].emission.z = emission;
    const Outcome outcome = radiosity::solve(scene, coarse());
    REQUIRE_FALSE(outcome.solution);
    CHECK(outcome.failure.sentences.front().find("'wall'") != std::string::npos);
  }
}

TEST_CASE("extreme: touching patches: the mean row sum is 1 within 1e-3 before any correction, however fine the corner; after it each is") {
  // Leaves in a corner inherit from coarse links above them: one by one their rows err by more, the finer the corner the more.
  for (const double finest : {1e-2, 1e-4}) {
    Options options = coarse();
    options.min_area = finest;
    const Solution solution = solved(scenes::furnace_cube(0.9), options);
    CAPTURE(finest, solution.audit.computed_row_sum.min, solution.audit.computed_row_sum.max);
    CHECK(std::abs(solution.audit.computed_row_sum.mean - 1.0) < 1e-3);
    CHECK(std::abs(solution.audit.row_sum.min - 1.0) < 1e-3);
    CHECK(std::abs(solution.audit.row_sum.max - 1.0) < 1e-3);
  }
}

TEST_CASE("extreme: a needle a million times longer than wide is refined along its length and gives no NaN") {
  Scene scene = scenes::two_plates(0.5);
  scene.objects.push_back(plate("needle", {{0, 0.5, 0.5}, {1, 0.5, 0.5}, {1, 0.500001, 0.5}, {0, 0.500001, 0.5}}, 1));
  const Solution solution = solved(scene);
  CHECK(solution.audit.converged);
  CHECK(solution.audit.energy_balance < 1e-6);
  CHECK(mean(solution, "needle") > 0.0);
}

TEST_CASE("extreme: scale 1e-6 and 1e6, and offset 1e3: the same radiosity within 1e-3") {
  // These factors are no powers of two: pairs of equal estimates are then told apart by rounding, and refined otherwise.
  const Solution one = solved(scenes::room_with_box());
  for (const auto& [scale, offset] : {std::pair{1e-6, 0.0}, std::pair{1e6, 0.0}, std::pair{1.0, 1e3}}) {
    const Solution other = solved(scenes::moved(scenes::room_with_box(), scale, glm::dvec3{offset}));
    CAPTURE(scale, offset);
    for (const char* name : {"room.x0", "room.z0", "box.z1"}) { CHECK(mean(other, name) == test::Approx(mean(one, name)).epsilon(1e-3)); }
  }
  // At 1e7 coordinates are known to 2e-9 of the room: faces that touch are no longer known to.
  const Solution far = solved(scenes::moved(scenes::room_with_box(), 1.0, glm::dvec3{1e7}));
  CHECK(mean(far, "room.z0") == test::Approx(mean(one, "room.z0")).epsilon(1e-2));
}

TEST_CASE("extreme: emission of 2^-100 and 2^100 gives the same bits, scaled") {
  const Solution one = solved(scenes::room_with_box());
  for (const double factor : {0x1p-100, 0x1p100}) {
    Scene scene = scenes::room_with_box();
    scene.materials[1].emission *= factor;
    const Solution other = solved(scene);
    REQUIRE(other.radiosity.size() == one.radiosity.size());
    for (std::size_t i = 0; i < one.radiosity.size(); ++i) { REQUIRE(other.radiosity[i].x == factor * one.radiosity[i].x); }
  }
}

TEST_CASE("extreme: a lamp of a ten thousandth of the scene lights as the inverse square says") {
  for (const double distance : {0.1, 1.0}) {
    Scene scene;
    scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1e8}}};
    scene.objects = {square("lamp", 0, 0, distance, 5e-5, false, 1), square("target", 0, 0, 0, 1e-2, true, 0)};
    const Solution solution = solved(scene);
    const double irradiance = 1e8 * 1e-8 / (std::numbers::pi * distance * distance);
    // Over the target r^2 is larger by (2e-4 / 3) / distance^2 in the mean, and the cosines fall as much again.
    CHECK(mean(solution, "target") == test::Approx(0.5 * irradiance).epsilon(3e-4 / (distance * distance)));
  }
}

TEST_CASE("extreme: patches that touch are refined to the smallest area asked for and no deeper") {
  Scene scene;
  scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}};
  scene.objects = {plate("floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1),
                   plate("wall", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}})};
  Options options = coarse();
  options.min_area = 1e-6;
  const Solution solution = solved(scene, options);
  CHECK(solution.audit.links < 2'000'000);
  // The lamp is black: the wall has what it gets at once. The factor is that of adjacent walls of a cube.
  CHECK(mean(solution, "wall") == test::Approx(0.5 * 0.20004377607540315).epsilon(1e-3));
}

TEST_CASE("extreme: coplanar plates exchange nothing; of two plates in one place the later one is seen") {
  Scene scene;
  scene.materials = {{"lamp", Color{0.5}, Color{1.0}}, {"wall", Color{0.5}, Color{0.0}}};
  scene.objects = {square("lamp", 0, 0, 0, 0.5, true, 0), square("beside", 1, 0, 0, 0.5, true, 1)};
  CHECK(mean(solved(scene), "beside") == 0.0);

  Scene twice = scenes::two_plates(0.5);
  const Solution once = solved(twice);
  twice.objects.push_back(twice.objects[1]);
  twice.objects.back().name = "again";
  const Solution solution = solved(twice);
  CHECK(mean(solution, "again") == test::Approx(mean(once, "upper")).epsilon(1e-9));
  CHECK(mean(solution, "lower") == test::Approx(mean(once, "lower")).epsilon(1e-9));
  CHECK(solution.audit.surfaces[1].area == 0.0);  // covered
}

TEST_CASE("extreme: an open shell is lit on its bright side alone, and what escapes is reported") {
  Scene scene = scenes::two_plates(0.5);
  scene.objects.push_back(square("away", 0.5, 0.5, 1.5, 0.5, true, 1));   // behind the upper plate, looking up
  scene.objects.push_back(square("back", 0.5, 0.5, -0.5, 0.5, true, 1));  // below the lamp: sees its black back
  const Solution solution = solved(scene);
  CHECK(mean(solution, "away") == 0.0);
  CHECK(mean(solution, "back") == 0.0);
  CHECK(solution.audit.escaped > 0.5);
}

TEST_CASE("extreme: a ring that shadows itself glows evenly in a furnace") {
  Scene scene = scenes::furnace_cube(0.9);
  scene.objects.push_back(scenes::object("ring", raycast::Torus::make({0.5, 0.5, 0.5}, {0, 0, 1}, 0.25, 0.1).object));
  const Solution solution = solved(scene);
  CHECK(mean(solution, "ring") == test::Approx(1.0).epsilon(1e-3));
}

TEST_CASE("extreme: a box inside a solid box is dark and gives no NaN") {
  Scene scene = scenes::room_with_box();
  scene.objects.push_back(scenes::object("hidden", scenes::box({0.35, 0.25, 0.1}, {0.5, 0.4, 0.3})));
  const Solution solution = solved(scene);
  const Solution without = solved(scenes::room_with_box());
  CHECK(mean(solution, "hidden.x0") == 0.0);
  CHECK(mean(solution, "room.z0") == test::Approx(mean(without, "room.z0")).epsilon(0.02));
}

TEST_CASE("extreme: a lamp that is wholly hidden lights nothing beyond, and one a thousandth below the ceiling lights like one in it") {
  Scene hidden = scenes::two_plates(0.5);
  hidden.objects.push_back(scenes::object("cap", scenes::box({-1.0, -1.0, 0.5}, {2.0, 2.0, 0.6}), 1));
  CHECK(mean(solved(hidden), "upper") == 0.0);

  Scene flush = scenes::room_with_box();
  Scene hung = flush;
  hung.objects[2] = square("lamp", 0.5, 0.5, 0.999, 0.15, false, 1);
  for (const char* name : {"room.z0", "room.x0", "box.z1"}) {
    CHECK(mean(solved(hung), name) ==
          test::Approx(mean(solved(flush), name))
              .epsilon(0.05));  // below the ceiling the room is not proven closed, and its rows are not corrected
  }
}

TEST_CASE("extreme: a plate in the plane of a wall, but beyond the wall, does not pass for lying on it: the scene is not proven closed") {
  // An L of unit arms, two high; the notch is x, y > 1. The plate lies in the plane of the wall y = 2.
  const auto plate_from = [](double x0, double x1) {
    Scene scene;
    scene.materials = {{"white", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{5.0}}};
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0},
                                          {0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {1, 1, 2}, {1, 2, 2}, {0, 2, 2}};
    std::vector<std::vector<std::uint32_t>> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (std::uint32_t i = 0; i < 6; ++i) { faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i}); }
    scene.objects = {scenes::object("room", raycast::Mesh::make(corners, faces).object, 0, true),
                     plate("lamp", {{x0, 2, 0.5}, {x1, 2, 0.5}, {x1, 2, 1.5}, {x0, 2, 1.5}}, 1)};
    Options options = coarse();
    options.min_area = 0.02;
    return solved(scene, options);
  };
  CHECK(plate_from(0.2, 0.8).audit.closure);
  CHECK(plate_from(0.0, 1.0).audit.closure);  // up to the borders of the wall
  CHECK_FALSE(plate_from(0.8, 1.4).audit.closure);
  CHECK_FALSE(plate_from(0.2, 1.001).audit.closure);
  // All of it behind the wall x = 1, or beyond the whole room: it is buried, and so is its light.
  for (const double x : {1.2, 2.2}) {
    const Solution solution = plate_from(x, x + 0.6);
    CHECK_FALSE(solution.audit.closure);
    CHECK(mean(solution, "room.f0") == 0.0);
  }
}
