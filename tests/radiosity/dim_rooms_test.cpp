// SPDX-License-Identifier: MIT

// Two rooms with a small hole in the wall between them. The lamps are in one, the camera in the other: all light that it sees came through
// the hole. What comes through, by paths from the plane of the hole into the bright room, is absorbed by the walls of the dim one.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/objects/box.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Random;

namespace {

// The dim room spans 0 to `dim`, the bright one lies beyond its wall at x = dim.x.
struct TwoRooms {
  glm::dvec3 dim{0.0}, hole_lo{0.0}, hole_hi{0.0};  // the hole in the plane x = dim.x
  double reflectance = 0.5;
  radiosity::Scene scene;

  [[nodiscard]] double hole_area() const { return (hole_hi.y - hole_lo.y) * (hole_hi.z - hole_lo.z); }
};

raycast::CsgNode part(const std::string& name, const glm::dvec3& lo, const glm::dvec3& hi) {
  return {raycast::BoxObject::make(lo, hi).object, name, {}, {}, {}};
}

TwoRooms two_rooms(Random& random) {
  const auto in = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  TwoRooms rooms;
  rooms.dim = {in(3, 6), in(3, 5), in(2.4, 3.5)};
  rooms.reflectance = in(0.4, 0.8);
  const double wall = in(0.05, 0.3), side = in(0.1, 0.3), bright = in(3, 6);
  const double y = in(0.5, rooms.dim.y - 1.0), z = in(0.5, rooms.dim.z - 1.0);
  rooms.hole_lo = {rooms.dim.x, y, z};
  rooms.hole_hi = {rooms.dim.x, y + side, z + side};
  const double from = rooms.dim.x + wall, to = from + bright;
  raycast::CsgNode house{{}, "house", raycast::CsgOperation::subtract, {}, {}};
  house.parts = {part("outside", glm::dvec3{-0.2}, {to + 0.2, rooms.dim.y + 0.2, rooms.dim.z + 0.2}),
                 part("dim", glm::dvec3{0.0}, rooms.dim), part("bright", {from, 0, 0}, {to, rooms.dim.y, rooms.dim.z}),
                 part("hole", rooms.hole_lo - glm::dvec3{0.1, 0, 0}, rooms.hole_hi + glm::dvec3{wall + 0.1, 0, 0})};
  rooms.scene.materials = {{"wall", Color{rooms.reflectance}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}};
  rooms.scene.objects = {scenes::object("house", raycast::Csg::make(house).object)};
  const glm::dvec3 lamp{in(from + 0.3, to - 1.0), in(0.3, rooms.dim.y - 1.0), rooms.dim.z - 0.1};
  rooms.scene.objects.push_back(
      scenes::plate("lamp", {lamp, lamp + glm::dvec3{0, 0.6, 0}, lamp + glm::dvec3{0.6, 0.6, 0}, lamp + glm::dvec3{0.6, 0, 0}}, 1));
  return rooms;
}

// The same with a hole of centimetres, and instead of the bright room a sun before it.
TwoRooms camera_obscura(Random& random) {
  const auto in = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  TwoRooms rooms;
  rooms.dim = {in(3, 5), in(3, 4), in(2.4, 3.0)};
  rooms.reflectance = in(0.4, 0.8);
  const double wall = in(0.02, 0.1), side = in(0.03, 0.06), y = in(1, rooms.dim.y - 1), z = in(1, rooms.dim.z - 1);
  rooms.hole_lo = {rooms.dim.x, y, z};
  rooms.hole_hi = {rooms.dim.x, y + side, z + side};
  raycast::CsgNode house{{}, "house", raycast::CsgOperation::subtract, {}, {}};
  house.parts = {part("outside", glm::dvec3{-0.2}, rooms.dim + glm::dvec3{wall, 0.2, 0.2}), part("dim", glm::dvec3{0.0}, rooms.dim),
                 part("hole", rooms.hole_lo - glm::dvec3{0.1, 0, 0}, rooms.hole_hi + glm::dvec3{wall + 0.1, 0, 0})};
  rooms.scene.materials = {{"wall", Color{rooms.reflectance}, Color{0.0}}, {"sun", Color{0.0}, Color{1e6}}};
  rooms.scene.objects = {scenes::object("house", raycast::Csg::make(house).object)};
  const glm::dvec3 sun{40.0, y + in(-1, 1), z + in(-1, 1)};
  rooms.scene.objects.push_back(
      scenes::plate("sun", {sun, sun + glm::dvec3{0, 0, 2}, sun + glm::dvec3{0, 2, 2}, sun + glm::dvec3{0, 2, 0}}, 1));
  return rooms;
}

double absorbed_in_dim_room(const TwoRooms& rooms) {
  const glm::dvec3 eye = 0.5 * rooms.dim;
  radiosity::Control control;
  control.viewpoint = radiosity::Viewpoint{eye, [&](const glm::dvec3& p, const glm::dvec3& n) {  // all that lies ahead, by solid angle
                                             const glm::dvec3 d = p - eye;
                                             return d.x < 0.0 ? std::max(0.0, -glm::dot(d, n)) / std::pow(glm::dot(d, d), 1.5) : 0.0;
                                           }};
  const radiosity::Options options{.audit_points = 0};
  const radiosity::Solution s = scenes::solved(rooms.scene, options, control);
  double sum = 0.0;
  for (std::size_t i = 0; i < s.hierarchy.size(); ++i) {
    const radiosity::Node& node = s.hierarchy[i];
    const raycast::Box room{glm::dvec3{-1e-3}, rooms.dim + 1e-3};
    if (!node.leaf() || node.is_cluster() || node.object != 0 || !room.contains(s.frame.to_scene(node.centre))) { continue; }
    sum += s.area[i] * s.radiosity[i].x;
  }
  return sum / (s.frame.scale * s.frame.scale) * (1.0 - rooms.reflectance) / rooms.reflectance;
}

// The sheet of the first object that lies nearest to a point and faces -x.
std::uint32_t sheet_of_wall(const radiosity::Prepared& prepared, const glm::dvec3& at) {
  const glm::dvec3 point = (at - prepared.frame.centre) * prepared.frame.scale;
  std::uint32_t wall = 0;
  double nearest = 1e300;
  for (std::uint32_t sheet = 0; sheet < prepared.objects.object(0).sheet_count(); ++sheet) {
    const auto found = prepared.objects.object(0).project(sheet, point);
    const double off = glm::length(found.position - point);
    if (off < nearest && found.normal.x < -0.5) {
      nearest = off;
      wall = sheet;
    }
  }
  return wall;
}

double comes_through(const TwoRooms& rooms, Random& random) {
  const auto result = radiosity::prepare(rooms.scene);
  REQUIRE(result.prepared);
  const radiosity::Prepared& p = *result.prepared;
  const radiosity::PathTracer tracer{rooms.scene, p.objects, p.surfaces};
  const glm::dvec3 middle{rooms.dim.x, 0.25 * rooms.dim.y, 0.5 * rooms.dim.z};
  const std::uint32_t wall = sheet_of_wall(p, middle);  // the plane of the hole
  constexpr int paths = 20000;
  double sum = 0.0;
  std::uint64_t rays = 0;
  for (int k = 0; k < paths; ++k) {
    const glm::dvec3 x{rooms.dim.x, rooms.hole_lo.y + random.uniform() * (rooms.hole_hi.y - rooms.hole_lo.y),
                       rooms.hole_lo.z + random.uniform() * (rooms.hole_hi.z - rooms.hole_lo.z)};
    sum += tracer.radiosity({{(x - p.frame.centre) * p.frame.scale, {1, 0, 0}}, 0, wall}, random, rays).all.x;
  }
  return sum / paths / rooms.reflectance * rooms.hole_area();
}

// |log| of the light of each room over that which comes through, ascending, without the worst.
std::vector<double> errors(TwoRooms (*make)(Random&), Random& random) {
  constexpr int trials = 8;
  std::vector<double> off;
  for (int trial = 0; trial < trials; ++trial) {
    const TwoRooms rooms = make(random);
    off.push_back(std::abs(std::log(absorbed_in_dim_room(rooms) / comes_through(rooms, random))));
  }
  std::sort(off.begin(), off.end());
  off.pop_back();
  return off;
}

// A row of cells between walls that leave gaps at alternate ends. The lamp is in the first, all of the light of the last went around every
// corner.
struct Labyrinth {
  glm::dvec3 size{0.0};
  double last = 0.0;  // x where the last cell begins
  radiosity::Scene scene;
};

Labyrinth labyrinth(Random& random) {
  const auto in = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  const int cells = 5 + static_cast<int>(2.0 * random.uniform());
  const double wide = in(0.9, 1.2), thick = 0.1, gap = in(0.7, 0.9);
  Labyrinth made{{cells * wide + (cells - 1) * thick, in(3, 4), in(2.4, 3)}, (cells - 1) * (wide + thick), {}};
  made.scene.materials = {{"white", Color{in(0.93, 0.97)}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}};
  made.scene.objects = {scenes::object("room", raycast::BoxObject::make(glm::dvec3{0.0}, made.size).object)};
  made.scene.objects.front().placement.inside = true;
  for (int k = 1; k < cells; ++k) {
    const double x = k * (wide + thick) - thick, from = k % 2 == 0 ? 0.0 : gap, to = made.size.y - (k % 2 == 0 ? gap : 0.0);
    made.scene.objects.push_back(
        scenes::object("wall" + std::to_string(k), raycast::BoxObject::make({x, from, 0}, {x + thick, to, made.size.z}).object));
  }
  const glm::dvec3 lamp{0.25 * wide, 1.5, made.size.z - 0.1};
  made.scene.objects.push_back(scenes::object("lamp", raycast::BoxObject::make(lamp, {lamp.x + 0.4, lamp.y + 1.0, made.size.z}).object, 1));
  return made;
}

// The mean radiosity of the wall at the end, solved for a camera in the last cell.
double at_the_end(const Labyrinth& labyrinth) {
  const glm::dvec3 eye{0.5 * (labyrinth.last + labyrinth.size.x), 0.5 * labyrinth.size.y, 0.5 * labyrinth.size.z};
  radiosity::Control control;
  control.viewpoint = radiosity::Viewpoint{eye, [&](const glm::dvec3& p, const glm::dvec3& n) {  // all around, by solid angle
                                             const glm::dvec3 d = p - eye;
                                             return std::max(0.0, -glm::dot(d, n)) / std::pow(glm::dot(d, d), 1.5);
                                           }};
  const radiosity::Options options{.audit_points = 0};
  const radiosity::Solution s = scenes::solved(labyrinth.scene, options, control);
  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < s.hierarchy.size(); ++i) {
    const radiosity::Node& node = s.hierarchy[i];
    if (!node.leaf() || node.is_cluster() || node.object != 0 || s.frame.to_scene(node.centre).x < labyrinth.size.x - 1e-6) { continue; }
    sum += s.area[i] * s.radiosity[i].x;
    area += s.area[i];
  }
  REQUIRE(area > 0.0);
  return sum / area;
}

// The same by path tracing, and its standard error as a share of it.
struct Traced {
  double mean = 0.0, error = 0.0;
};
Traced traced_at_the_end(const Labyrinth& labyrinth, Random& random) {
  const auto result = radiosity::prepare(labyrinth.scene);
  REQUIRE(result.prepared);
  const radiosity::Prepared& p = *result.prepared;
  const radiosity::PathTracer tracer{labyrinth.scene, p.objects, p.surfaces};
  const auto in_frame = [&](const glm::dvec3& x) { return (x - p.frame.centre) * p.frame.scale; };
  const glm::dvec3& size = labyrinth.size;
  const std::uint32_t end = sheet_of_wall(p, 0.5 * size + glm::dvec3{0.5 * size.x, 0, 0});
  constexpr int paths = 20000;
  double sum = 0.0, square = 0.0;
  std::uint64_t rays = 0;
  for (int k = 0; k < paths; ++k) {
    const glm::dvec3 x{size.x, random.uniform() * size.y, random.uniform() * size.z};
    const double one = tracer.radiosity({{in_frame(x), {-1, 0, 0}}, 0, end}, random, rays).all.x;
    sum += one;
    square += one * one;
  }
  return {sum / paths, std::sqrt(square) / sum};
}

}  // namespace

// By links, with one visible fraction each, the light of a room was 14 to 26 % off (RMS). By rays it is 2 to 8 %, of which some 2 % goes to
// the sides of the hole and back through it. What the lamp sends straight through the hole goes by links still, of 256 segments: with 16,
// one room in fifty got half or twice its light. The worst room of eight is left out: few rays meet the narrowest holes.
TEST_CASE("a dim room that is lit through a small hole alone gets what comes through", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 1};
  const std::vector<double> off = errors(two_rooms, random);
  CAPTURE(off);
  CHECK(std::sqrt(std::inner_product(off.begin(), off.end(), off.begin(), 0.0) / static_cast<double>(off.size())) < 0.13);
}

// Of the segments between the sun and a wall one in some thousand passes the hole. With 256 most rooms were dark; with as many as make four
// million in all for the few links of the sun, its light is some 20 % off. The worst room of eight is left out: where one of the few paths
// from the eye meets the spot by chance, the room is not taken for a dim one.
TEST_CASE("a dark room into which a sun shines through a hole of centimetres gets what comes through", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 2};
  const std::vector<double> off = errors(camera_obscura, random);
  CAPTURE(off);
  CHECK(off[off.size() / 2] < 0.3);
  CHECK(off.back() < 0.7);
}

// Within some 5 %, as measured; twice as much is allowed, and the noise of the paths. While the brightness of what the camera sees was
// computed from eight reflections, and importance followed one, cells had casters as large as their floors, and the last got up to 2.6
// times its light.
TEST_CASE("the last cell of a white labyrinth gets the light that goes around all of its corners", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 3};
  for (int trial = 0; trial < 2; ++trial) {
    const Labyrinth made = labyrinth(random);
    const double solved = at_the_end(made);
    const Traced traced = traced_at_the_end(made, random);
    CAPTURE(trial, solved, traced.mean, traced.error);
    CHECK(std::abs(std::log(solved / traced.mean)) < 0.1 + 3.0 * traced.error);
  }
}
