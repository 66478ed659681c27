// SPDX-License-Identifier: MIT

// Laws of the matrix of form factors: reciprocity, row sums, covered ground, faces against rays, and of the total exchange.

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/factors/factor_rows.hpp>
#include <radiosity/factors/factor_run.hpp>
#include <radiosity/factors/factors.hpp>
#include <radiosity/factors/total_exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/shadow.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>

#include "catch.hpp"
#include "factors_of.hpp"
#include "scenes.hpp"

using radiosity::Factors;
using radiosity::Scene;
using scenes::factors_of;
using scenes::grey;

namespace {

std::size_t row(const Factors& f, const std::string& name) {
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    if (f.surfaces[i].name == name) { return i; }
  }
  FAIL("no surface " << name);
  return 0;
}

}  // namespace

TEST_CASE("Sobol points: any 16 of a sequence that begin at a multiple of 16 fill the 16 strips of each coordinate") {
  const radiosity::Sobol4 sequence{7, 3};
  for (const std::uint32_t first : {0u, 16u, 4096u}) {
    std::uint32_t seen[4] = {0, 0, 0, 0};
    for (std::uint32_t i = first; i < first + 16; ++i) {
      const auto u = sequence(i);
      for (std::size_t d = 0; d < 4; ++d) { seen[d] |= 1u << static_cast<unsigned>(u[d] * 16.0); }
    }
    for (const std::uint32_t s : seen) { CHECK(s == 0xffffu); }
  }
}

TEST_CASE("a point sees nothing of a square behind a larger one, and all of it beside") {
  const radiosity::Polygon target{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const radiosity::Polygon plate{{-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}};
  const radiosity::Polygon half{{-1, -1, 0.5}, {0.5, -1, 0.5}, {0.5, 2, 0.5}, {-1, 2, 0.5}};
  const radiosity::Polygon beside{{2, 0, 0.5}, {3, 0, 0.5}, {3, 1, 0.5}, {2, 1, 0.5}};
  const glm::dvec3 up{0, 0, 1};
  const glm::dvec3 x{0.5, 0.5, 0};
  const double free = radiosity::point_to_polygon(x, up, target);
  const auto seen = [&](const radiosity::Polygon& blocker) {
    const radiosity::Blocker one{blocker, up};
    return radiosity::ShadowedTarget{target, -up, {&one, 1}, 1e-9}.form_factor(x, up);
  };
  CHECK(seen(plate) == 0.0);
  CHECK(seen(beside) == test::Approx(free).epsilon(1e-14));
  CHECK(seen(half) == test::Approx(0.5 * free).epsilon(1e-14));  // by symmetry
}

// The square has corners on both sides of either plane, but passes beside their edge.
TEST_CASE("what a cone does not touch stays in one piece") {
  radiosity::Piece square;
  for (const glm::dvec3& p : {glm::dvec3{1, 0, 1}, glm::dvec3{0, 1, 1}, glm::dvec3{-1, 0, 1}, glm::dvec3{0, -1, 1}}) {
    square.push_back(p);
  }
  std::vector<radiosity::Piece> pieces{square};
  const glm::dvec3 tip{0.6, 0.6, 1};
  const std::array<radiosity::HalfSpace, 2> cone{radiosity::HalfSpace{tip, {1, 0, 0}}, radiosity::HalfSpace{tip, {0, 1, 0}}};
  radiosity::detail::cut_away(pieces, cone);
  REQUIRE(pieces.size() == 1);
  CHECK(std::equal(pieces[0].begin(), pieces[0].end(), square.begin(), square.end()));
}

TEST_CASE("factors: reciprocity is exact, and a closed room with a lamp and a box on its floor has row sums of 1") {
  const Factors f = factors_of(scenes::room_with_box());
  CHECK(f.rays == 0);
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    const double area = f.surfaces[i].area.value;
    for (std::size_t j = 0; j < f.surfaces.size(); ++j) {
      CHECK(area * f(i, j).value == test::Approx(f.surfaces[j].area.value * f(j, i).value).epsilon(1e-14).margin(1e-18));
    }
    if (area > 0.0) { CHECK(std::abs(f.surfaces[i].row_sum.value - 1.0) <= 1e-5); }  // ten factors, 1e-6 each
  }
  // Ground under the box and behind the lamp is left out; the bottom of the box sees nothing.
  CHECK(f.surfaces[row(f, "room.z0")].area.value == test::Approx(1.0 - 0.09).epsilon(1e-12));
  CHECK(f.surfaces[row(f, "room.z1")].area.value == test::Approx(1.0 - 0.09).epsilon(1e-12));
  CHECK(f.surfaces[row(f, "box.z0")].area.value == 0.0);
  CHECK(f.surfaces[row(f, "box.z0")].row_sum.value == 0.0);
}

TEST_CASE("factors: a column in a closed room, however it stands: rows sum to 1 within the errors that are stated") {
  // Walls and column are upright, so the edges of all shadows of walls on walls are parallel to the elements of the quadrature.
  constexpr std::uint64_t seed = 4;
  CAPTURE(seed);
  std::mt19937_64 engine{seed};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  constexpr double right_angle = 0.5 * std::numbers::pi;
  for (int trial = 0; trial < 3; ++trial) {
    CAPTURE(trial);
    const double height = 0.5 + 3.0 * uniform(engine), size = 0.2 + 0.4 * uniform(engine);
    const double turn = trial % 2 == 0 ? 0.0 : uniform(engine) - 0.5;  // by less than half a right angle: corner k is next to corner k
    const glm::dvec2 middle{0.6 * uniform(engine) - 0.3, 0.6 * uniform(engine) - 0.3};
    std::array<glm::dvec3, 4> room{}, column{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = right_angle * (static_cast<double>(k) + 0.5);
      room[k] = 2.0 * glm::dvec3{std::cos(angle), std::sin(angle), 0.0};
      column[k] = glm::dvec3{middle, 0.0} + size * glm::dvec3{std::cos(angle + turn), std::sin(angle + turn), 0.0};
    }
    const glm::dvec3 up{0.0, 0.0, height};
    Scene scene = grey();
    std::vector<glm::dvec3> corners;
    std::vector<std::vector<std::uint32_t>> floor, ceiling;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      scene.objects.push_back(scenes::object("wall", scenes::polygon({room[next], room[k], room[k] + up, room[next] + up})));
      scene.objects.push_back(scenes::object("column", scenes::polygon({column[k], column[next], column[next] + up, column[k] + up})));
      floor.push_back({k, next, 4 + next, 4 + k});
      ceiling.push_back({4 + k, 4 + next, next, k});
    }
    for (const auto& ring : {room, column}) { corners.insert(corners.end(), ring.begin(), ring.end()); }
    scene.objects.push_back(scenes::object("floor", raycast::Mesh::make(corners, floor).object));
    for (glm::dvec3& p : corners) { p += up; }
    scene.objects.push_back(scenes::object("ceiling", raycast::Mesh::make(corners, ceiling).object));
    const Factors f = factors_of(scene);
    CHECK(f.rays == 0);
    for (const Factors::Surface& s : f.surfaces) {
      CAPTURE(s.name);
      CHECK(std::abs(s.row_sum.value - 1.0) <= s.row_sum.error);
    }
  }
}

TEST_CASE("factors: what faces say and what rays say of the same room agree within the errors of the rays") {
  const Scene scene = scenes::room_with_box();
  const Factors f = factors_of(scene);
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  radiosity::FactorRows rows = radiosity::name_rows(scene);
  radiosity::expose(rows, prepared.prepared->objects, radiosity::flat_faces(prepared.prepared->surfaces), 1e-9);
  const auto n = static_cast<std::uint32_t>(rows.rows.size());
  int compared = 0;
  double chi = 0.0;
  for (const std::string name : {"room.x0", "room.z1", "box.z1", "lamp"}) {
    const auto i = static_cast<std::uint32_t>(row(f, name));
    const radiosity::RaySource source{rows.rows[i].object, false, rows.rows[i].facets, i, 1, {}};
    radiosity::RayCounter counter{prepared.prepared->objects, rows.row_of, source, n, 1};
    counter.extend(2048, 1);
    for (std::uint32_t j = 0; j < n; ++j) {
      const radiosity::RayCounter::Mean rays = counter.factor(i, j);
      const double z = (rays.value - f(i, j).value) / rays.error;
      CAPTURE(name, f.surfaces[j].name, rays.value, rays.error, f(i, j).value);
      CHECK(std::abs(z) < 5.0);  // of Student's distribution with 15 degrees of freedom: one in 6000
      chi += z * z;
      ++compared;
    }
    CHECK(counter.sum(i).value == 1.0);  // every ray arrives
  }
  CHECK(chi / compared < 2.0);
}

TEST_CASE("factors: lines through a sphere, a cylinder and a disk count their areas") {
  Scene scene = grey();
  scene.objects = {scenes::object("ball", raycast::Sphere::make({0, 0, 0}, 1.0).object),
                   scenes::object("can", raycast::Cylinder::make({3, 0, 0}, {0, 1, 1}, 0.5).object),
                   scenes::object("spot", raycast::Disk::make({0, 3, 0}, {0, -1, 0}, 1.0).object)};
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  const radiosity::FactorRows rows = radiosity::name_rows(scene);
  const double unit = prepared.prepared->frame.to_scene_area(1.0);
  const double pi = std::numbers::pi;
  const double areas[5] = {4.0 * pi, 2.0 * pi * 0.5 * std::sqrt(2.0), pi * 0.25, pi * 0.25, pi};
  for (const auto& [object, first, count] : {std::tuple{0u, 0u, 1u}, std::tuple{1u, 1u, 3u}, std::tuple{2u, 4u, 1u}}) {
    radiosity::RayCounter counter{prepared.prepared->objects, rows.row_of, {object, false, {}, first, count, rows.row_of[object]}, 5, 1};
    counter.extend(1024, 1);
    for (std::uint32_t i = first; i < first + count; ++i) {
      const auto area = counter.area(i);
      CAPTURE(rows.rows[i].name, area.value * unit, area.error * unit);
      CHECK(std::abs(area.value * unit - areas[i]) <= 5.0 * area.error * unit);
      CHECK(area.error <= 0.02 * area.value);
    }
  }
}

TEST_CASE("factors: a closed room with round things in it: row sums of 1 within the errors, the same bits with any number of threads") {
  const Scene scene = scenes::furnace_with_things(0.5);
  const Factors f = factors_of(scene, 4e-3);
  CHECK(f.rays > 0);
  for (const Factors::Surface& s : f.surfaces) {
    CAPTURE(s.name, s.area.value, s.row_sum.value, s.row_sum.error);
    if (s.area.value > 0.0) { CHECK(std::abs(s.row_sum.value - 1.0) <= 4.0 * s.row_sum.error); }
  }
  const Factors again = factors_of(scene, 4e-3, 3);
  for (std::size_t k = 0; k < f.factor.size(); ++k) { CHECK(f.factor[k].value == again.factor[k].value); }
}

TEST_CASE("factors: surfaces are named sheets, the faces of a mesh are one surface for each material") {
  Scene scene = grey();
  scene.materials.push_back({"red", radiosity::Color{0.5, 0.1, 0.1}, radiosity::Color{0.0}});
  const std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene.objects = {scenes::object("wedge", raycast::Mesh::make(corners, faces).object, 0, true),
                   scenes::object("two", raycast::Mesh::make({{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {5, 5, 6}}, faces).object, 0, true)};
  scene.objects[1].material = {0, 1, 0, 0};
  const radiosity::FactorRows rows = radiosity::name_rows(scene);
  REQUIRE(rows.rows.size() == 3);
  CHECK(rows.rows[0].name == "wedge");
  CHECK(rows.rows[1].name == "two.grey");
  CHECK(rows.rows[2].name == "two.red");
  CHECK(rows.row_of[1] == std::vector<std::uint32_t>{1, 2, 1, 1});
  scene.objects.resize(1);
  CHECK(factors_of(scene)(0, 0).value == test::Approx(1.0).epsilon(1e-7));  // a closed room sees itself alone
}

TEST_CASE("factors: scaling by a power of two gives the same bits, moving by 1e5 changes them by less than 1e-6") {
  const Factors f = factors_of(scenes::room_with_box());
  const Factors large = factors_of(scenes::moved(scenes::room_with_box(), 0x1p20, glm::dvec3{0.0}));
  const Factors far = factors_of(scenes::moved(scenes::room_with_box(), 1.0, {1e5, -1e5, 1e5}));
  for (std::size_t k = 0; k < f.factor.size(); ++k) {
    CHECK(f.factor[k].value == large.factor[k].value);
    // Coordinates of 1e5 are known to 1.5e-11; the quadrature may part its elements otherwise.
    CHECK(std::abs(f.factor[k].value - far.factor[k].value) <= 1e-6);
  }
}

TEST_CASE("factors: what a solid keeps of its parts is a row, what is cut away is none, and what is buried has area 0") {
  Scene scene = grey();
  const raycast::CsgNode block{scenes::box({0, 0, 0}, {1, 1, 1}), "block", {}, {}, {}};
  const raycast::CsgNode slot{scenes::box({0.25, -1, 0.5}, {0.75, 2, 2}), "slot", {}, {}, {}};
  scene.objects = {scenes::object("room", scenes::box({-1, -1, 0}, {2, 2, 3}), 0, true),
                   scenes::object("solid", raycast::Csg::make({{}, {}, raycast::CsgOperation::subtract, {block, slot}, {}}).object)};
  const Factors f = factors_of(scene);
  std::vector<std::string> names;
  for (const Factors::Surface& s : f.surfaces) { names.push_back(s.name); }
  const std::vector<std::string> wanted{"room.x0",        "room.x1",        "room.y0",        "room.y1",        "room.z0",
                                        "room.z1",        "solid.block.x0", "solid.block.x1", "solid.block.y0", "solid.block.y1",
                                        "solid.block.z0", "solid.block.z1", "solid.slot.x0",  "solid.slot.x1",  "solid.slot.z0"};
  CHECK(names == wanted);
  CHECK(f.surfaces[row(f, "solid.block.z0")].area.value == 0.0);
  CHECK(f.surfaces[row(f, "room.z0")].area.value == test::Approx(8.0).epsilon(1e-6));
  for (const Factors::Surface& s : f.surfaces) {
    if (s.area.value > 0.0) { CHECK(std::abs(s.row_sum.value - 1.0) <= 2e-5); }  // fifteen factors, 1e-6 each
  }
}

TEST_CASE("factors: the wanted error is reached where areas come from rays, too: two balls that are one, in the open") {
  Scene scene = grey();
  const raycast::CsgNode left{raycast::Sphere::make({0, 0, 0}, 1.0).object, "left", {}, {}, {}};
  const raycast::CsgNode right{raycast::Sphere::make({1, 0, 0}, 1.0).object, "right", {}, {}, {}};
  scene.objects = {scenes::object("twins", raycast::Csg::make({{}, {}, raycast::CsgOperation::unite, {left, right}, {}}).object)};
  const Factors f = factors_of(scene, 2e-3);
  CHECK(f.converged);
  REQUIRE(f.surfaces.size() == 2);
  for (const Factors::Surface& s : f.surfaces) {  // each lacks a cap of height 1/2
    CHECK(std::abs(s.area.value - 3.0 * std::numbers::pi) <= 4.0 * s.area.error);
    CHECK(s.area.error <= 0.02 * s.area.value);
  }
  CHECK(f(0, 0).value == 0.0);
  CHECK(std::abs(f(0, 1).value - f(1, 0).value) <= 4.0 * (f(0, 1).error + f(1, 0).error));  // by symmetry
  CHECK(f(0, 1).value > 4.0 * f(0, 1).error);
}

TEST_CASE("total exchange: black surfaces exchange by their form factors, and reciprocity is exact") {
  const Factors f = factors_of(scenes::room_with_box());
  const std::size_t n = f.surfaces.size();
  const auto black = radiosity::total_exchange(f, std::vector<double>(n, 1.0));
  std::vector<double> emissivity;
  for (std::size_t i = 0; i < n; ++i) { emissivity.push_back(static_cast<double>(i % 4) / 3.0); }  // 0 and 1 among them
  const auto mixed = radiosity::total_exchange(f, emissivity);
  REQUIRE(black.exchange);
  REQUIRE(mixed.exchange);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      CHECK(black.exchange->factor[i * n + j].value == test::Approx(f(i, j).value).epsilon(1e-14).margin(1e-18));
      CHECK(black.exchange->factor[i * n + j].error >= f(i, j).error * (1.0 - 1e-12));
      CHECK(f.surfaces[i].area.value * mixed.exchange->factor[i * n + j].value ==
            test::Approx(f.surfaces[j].area.value * mixed.exchange->factor[j * n + i].value).epsilon(1e-13).margin(1e-18));
    }
    // The room is closed: what a surface absorbs when all have one temperature is what it emits. Row sums of F are 1 within 1e-5, and
    // in six bounces or so, a third of the surfaces being nearly black, that grows no more than tenfold.
    if (f.surfaces[i].area.value > 0.0) { CHECK(std::abs(mixed.exchange->row_sum[i].value - emissivity[i]) <= 1e-4); }
  }
}

TEST_CASE("total exchange: concentric spheres, 1 / (1 / e1 + (A1 / A2) (1 / e2 - 1)), and the errors of the form factors carried on") {
  const double pi = std::numbers::pi;
  const auto spheres = [&](double inner, double self) {  // F of the inner sphere to the outer one, and of the outer one to itself
    Factors f;
    f.surfaces = {{"inner", {4.0 * pi, 0.0}, {1.0, 0.0}}, {"outer", {16.0 * pi, 0.0}, {1.0, 0.0}}};
    f.factor = {{0.0, 0.0}, {inner, 1e-4}, {0.25 * inner, 0.25e-4}, {self, 0.0}};
    return f;
  };
  const std::vector<double> emissivity{0.3, 0.05};
  const auto result = radiosity::total_exchange(spheres(1.0, 0.75), emissivity);
  REQUIRE(result.exchange);
  const auto& script = result.exchange->factor;
  CHECK(script[1].value == test::Approx(1.0 / (1.0 / 0.3 + 0.25 * (1.0 / 0.05 - 1.0))).epsilon(1e-13));
  CHECK(result.exchange->row_sum[0].value == test::Approx(0.3).epsilon(1e-13));
  CHECK(result.exchange->row_sum[1].value == test::Approx(0.05).epsilon(1e-13));
  // One exchange is off by its error: what that changes is within what is stated, and at most twice below it. (A_1 script-F_12 depends on
  // the exchange through two terms of one sign, which are added in quadrature times the root of 2.)
  const auto moved = radiosity::total_exchange(spheres(1.0 - 1e-4, 0.75), emissivity);
  REQUIRE(moved.exchange);
  for (std::size_t k = 0; k < 4; ++k) {
    const double change = std::abs(moved.exchange->factor[k].value - script[k].value);
    CHECK(change <= 1.01 * script[k].error);
    CHECK(change >= 0.49 * script[k].error);
  }
}

TEST_CASE("total exchange: a mirror room has no steady state, and impossible emissivities are refused") {
  const Factors f = factors_of(scenes::furnace_cube(0.5));
  CHECK(!radiosity::total_exchange(f, std::vector<double>(6, 0.0)).refusal.empty());
  CHECK(!radiosity::total_exchange(f, std::vector<double>(5, 0.5)).refusal.empty());
  CHECK(!radiosity::total_exchange(f, std::vector<double>(6, 1.5)).refusal.empty());
  const auto nearly = radiosity::total_exchange(f, std::vector<double>(6, 1e-3));
  REQUIRE(nearly.exchange);
  // Each wall exchanges with all six alike but for what the first bounces say.
  for (const radiosity::Estimate& sum : nearly.exchange->row_sum) { CHECK(std::abs(sum.value - 1e-3) <= 4.0 * sum.error); }
}

TEST_CASE("factors: faulty scenes and options are refused with a sentence") {
  CHECK(radiosity::factors(grey()).faults.size() == 1);
  const radiosity::FactorOptions options{.error = 0.0};
  CHECK(radiosity::factors(scenes::two_plates(0.5), options).faults.size() == 1);
}
