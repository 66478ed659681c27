// SPDX-License-Identifier: MIT

// What stands behind the stiff and extreme scenes, which are solved and measured by `halflight stress` (tests/apps/stress_test.cpp):
// warnings that name what is doubtful and nothing else, closing that is never done by force, faces that are cut at walls.

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <radiosity/audit/warnings.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/testing.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

using radiosity::Color;
using radiosity::Scene;

namespace {

std::vector<std::string> warnings_of(const Scene& scene) {
  const radiosity::PrepareResult made = radiosity::prepare(scene);
  for (const std::string& fault : made.faults) { UNSCOPED_INFO(fault); }
  REQUIRE(made.prepared);
  return radiosity::warnings(scene, made.prepared->frame, made.prepared->surfaces);
}

// Radiating faces of all objects after the cuts at walls.
std::vector<std::size_t> faces_of(const Scene& scene) {
  radiosity::PrepareResult made = radiosity::prepare(scene);
  REQUIRE(made.prepared);
  double area = 0.0;
  const auto total = [&] {
    double sum = 0.0;
    for (const radiosity::Surface& s : made.prepared->surfaces) {
      for (const brep::FaceId f : brep::faces(s.brep)) { sum += glm::length(radiosity::vector_area(radiosity::corner_polygon(s.brep, f))); }
    }
    return sum;
  };
  area = total();
  radiosity::cut_at_walls(made.prepared->surfaces, made.prepared->objects.diameter());
  CHECK(total() == test::Approx(area).epsilon(1e-12));
  std::vector<std::size_t> counts;
  for (const radiosity::Surface& s : made.prepared->surfaces) {
    CHECK(brep::validate(s.brep).empty());
    counts.push_back(radiosity::radiating_faces(s));
  }
  return counts;
}

}  // namespace

TEST_CASE("duplicates are warned of by name, and what only shares its bounds is not") {
  Scene scene = scenes::two_plates(0.5);
  CHECK(warnings_of(scene).empty());
  // Two triangles that make a square, a plate seen from the other side, a room of the same bounds.
  scene.objects = {scenes::plate("one half", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}),
                   scenes::plate("other half", {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}), scenes::plate("back", {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}}),
                   scenes::object("box", scenes::box({0, 0, 1}, {1, 1, 2})),
                   scenes::object("room", scenes::box({0, 0, 1}, {1, 1, 2}), 0, true)};
  CHECK(warnings_of(scene).empty());
  // The same corners, begun elsewhere and moved by rounding.
  scene.objects.push_back(scenes::plate("twin", {{1, 1, 1e-13}, {0, 0, 0}, {1, 0, 0}}));
  const auto sentences = warnings_of(scene);
  REQUIRE(sentences.size() == 1);
  CHECK(sentences[0].find("'one half' and 'twin' are the same surface") != std::string::npos);
}

TEST_CASE("however many duplicates and open shells there are, one sentence counts each kind") {
  for (const int count : {2, 7, 1000}) {
    Scene scene = scenes::two_plates(0.5);
    for (int i = 0; i < count; ++i) { scene.objects.push_back(scene.objects[0]); }
    const std::vector<std::string> sentences = warnings_of(scene);
    CAPTURE(count, sentences);
    REQUIRE(sentences.size() == 1);
    CHECK(sentences[0].find(std::to_string(count) + " objects are duplicates") == 0);
    CHECK((sentences[0].find("and others") != std::string::npos) == (count > 5));
  }
  Scene scene = scenes::two_plates(0.5);
  for (int i = 0; i < 7; ++i) {  // two triangles that share an edge
    const glm::dvec3 at{2.0 * i, 0, 3};
    const std::vector<glm::dvec3> corners{at, at + glm::dvec3{1, 0, 0}, at + glm::dvec3{1, 1, 0}, at + glm::dvec3{0, 1, 1}};
    scene.objects.push_back(scenes::object("shell", raycast::Mesh::make(corners, {{0, 1, 2}, {0, 2, 3}}).object));
  }
  const std::vector<std::string> sentences = warnings_of(scene);
  CAPTURE(sentences);
  REQUIRE(sentences.size() == 1);
  CHECK(sentences[0].find("7 objects are open shells, with 28 open edges") == 0);
}

TEST_CASE("an open shell is warned about when nothing goes on where it ends, not for a back or a part in another object") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    // A row of quadrilaterals, bent at random, with its back as an object of its own or in the same mesh.
    const std::uint32_t pieces = 2 + static_cast<std::uint32_t>(random() % 5);
    std::vector<glm::dvec3> corners;
    std::vector<std::vector<std::uint32_t>> front, back, both;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
      const double z = 5.0 + static_cast<double>(random() % 100) / 100.0;
      corners.insert(corners.end(), {{i, 0, z}, {i, 1, z}});
      if (i == 0) { continue; }
      front.push_back({2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1});
      back.push_back({front.back().rbegin(), front.back().rend()});
    }
    both = front;
    for (std::vector<std::uint32_t> face : back) {
      for (std::uint32_t& v : face) { v += 2 * pieces + 2; }
      both.push_back(face);
    }
    std::vector<glm::dvec3> twice = corners;
    twice.insert(twice.end(), corners.begin(), corners.end());
    const auto mesh = [](const std::string& name, const auto& positions, const auto& faces) {
      return scenes::object(name, raycast::Mesh::make(positions, faces).object);
    };
    Scene scene = scenes::two_plates(0.5);
    scene.objects.push_back(mesh("front", corners, front));
    const std::vector<std::string> alone = warnings_of(scene);
    REQUIRE(alone.size() == 1);
    CHECK(alone[0].find("'front' is an open shell with " + std::to_string(2 * pieces + 2) + " open edges") != std::string::npos);
    scene.objects.push_back(mesh("back", corners, back));
    CHECK(warnings_of(scene).empty());
    scene.objects.resize(scene.objects.size() - 2);
    scene.objects.push_back(mesh("both", twice, both));
    CHECK(warnings_of(scene).empty());
    // A part of the row in each of two objects: their common edge is no end.
    scene.objects.pop_back();
    const auto cut = static_cast<std::ptrdiff_t>(1 + random() % (pieces - 1));
    using Faces = std::vector<std::vector<std::uint32_t>>;
    scene.objects.push_back(mesh("left", corners, Faces(front.begin(), front.begin() + cut)));
    scene.objects.push_back(mesh("right", corners, Faces(front.begin() + cut, front.end())));
    const std::vector<std::string> parts = warnings_of(scene);
    const auto of = [](std::ptrdiff_t count) { return count > 1 ? 2 * count + 1 : 0; };  // polygons alone are not warned about
    const std::ptrdiff_t ends = of(cut) + of(pieces - cut);
    REQUIRE(parts.size() == (ends > 0 ? 1 : 0));
    CHECK((ends == 0 || parts[0].find(std::to_string(ends) + " open edges") != std::string::npos));
  }
}

TEST_CASE("however many objects are buried one sentence counts them, and each buried lamp has its own") {
  Scene scene = scenes::furnace_cube(0.5);
  scene.materials.push_back({"dark", Color{0.5}, Color{0.0}});
  scene.materials.push_back({"bulb", Color{0.0}, Color{1.0}});
  const auto dark = static_cast<std::uint32_t>(scene.materials.size() - 2);
  scene.objects.push_back(scenes::object("crate", scenes::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}), dark));
  const radiosity::Options options{.epsilon = 0.5, .min_area = 0.1, .audit_points = 0};
  for (const int count : {1, 2, 30}) {
    Scene full = scene;
    for (int i = 0; i < count; ++i) {
      const double at = 0.3 + 0.01 * i;
      full.objects.push_back(scenes::object("in" + std::to_string(i), scenes::box(glm::dvec3{at}, glm::dvec3{at + 0.005}), dark));
    }
    full.objects.push_back(scenes::object("lamp", scenes::box(glm::dvec3{0.7}, glm::dvec3{0.75}), dark + 1));
    const radiosity::Outcome outcome = radiosity::solve(full, options);
    REQUIRE(outcome.solution);
    const std::vector<std::string>& sentences = outcome.solution->audit.warnings;
    CAPTURE(count, sentences);
    REQUIRE(sentences.size() == 2);
    CHECK(sentences[0].find("'lamp' is buried") != std::string::npos);
    CHECK(sentences[0].find("its light is lost") != std::string::npos);
    CHECK(sentences[1].find(count == 1 ? "object 'in0' is buried" : std::to_string(count) + " objects are buried") == 0);
  }
}

TEST_CASE("a scene is closed by no more than its links explain: where a thousandth of the light is missing it is refused") {
  radiosity::Options options{.audit_points = 0};
  // Links that reach over many leaves err by what their linear kernels leave, some per cent in the corners of a room.
  options.epsilon = 0.1;
  options.min_area = 1e-3;
  const radiosity::Outcome coarse = radiosity::solve(scenes::furnace_cube(0.5), options);
  REQUIRE(coarse.solution);
  REQUIRE(coarse.solution->audit.closure);
  CHECK(coarse.solution->audit.closure_limit < 0.1);

  // On an even mesh every link joins two leaves, and is as exact as its form factor (exchange.hpp).
  options.epsilon = 1e-6;
  options.min_area = 0.02;
  options.light_epsilon = 1.0;
  radiosity::Outcome outcome = radiosity::solve(scenes::furnace_cube(0.5), options);
  REQUIRE(outcome.solution);
  radiosity::Solution& solution = *outcome.solution;
  REQUIRE(solution.audit.closure);
  CHECK(*solution.audit.closure <= solution.audit.closure_limit);
  CHECK(solution.audit.closure_limit < 1e-4);

  radiosity::Exposure exposure;
  exposure.area = exposure.whole = solution.area;
  exposure.partly_buried.assign(solution.area.size(), false);
  for (const radiosity::Node& node : solution.hierarchy) { exposure.centroid.push_back(node.centre); }  // squares, nothing buried
  double all = 0.0;
  for (const radiosity::Link& link : solution.links) { all += static_cast<double>(link.exchange); }
  radiosity::Links fewer = solution.links;
  for (double rest = all; rest > 0.999 * all; fewer.pop_back()) { rest -= static_cast<double>(fewer.back().exchange); }
  radiosity::Transport whole{solution.hierarchy, solution.links, exposure};
  radiosity::Transport less{solution.hierarchy, fewer, exposure};
  CHECK(whole.close(solution.audit.closure_limit));
  const std::vector<double> rows = less.row_sums();
  CHECK_FALSE(less.close(solution.audit.closure_limit));
  CHECK(less.row_sums() == rows);  // as they were
}

TEST_CASE("a wall cuts the faces on which it stands, and what does not divide them does not") {
  Scene room = scenes::room_with_box();
  CHECK(faces_of(room) == std::vector<std::size_t>{6, 6, 1});  // the box covers .3 of the floor's width
  // A wall through the room, of two boxes and with a door: floor and ceiling in five pieces each, two walls in three.
  room.objects[1] = scenes::object("wall", scenes::box({0.47, 0, 0}, {0.53, 0.4, 1}));
  room.objects.push_back(scenes::object("more wall", scenes::box({0.47, 0.6, 0}, {0.53, 1, 1})));
  const auto counts = faces_of(room);
  CHECK(counts[0] == 2 * 5 + 2 * 3 + 2);  // the strip of the floor: under one box, in the door, under the other
  // A sheet without thickness cuts in two.
  room.objects.resize(1);
  room.objects.push_back(scenes::plate("sheet", {{0.3, 0, 0}, {0.3, 1, 0}, {0.3, 1, 0.4}, {0.3, 0, 0.4}}));
  CHECK(faces_of(room) == std::vector<std::size_t>{6 + 1, 1});
  // Faces that only share an edge do not cut each other; nor does what stands behind.
  Scene corner;
  corner.materials = room.materials;
  corner.objects = {scenes::plate("floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
                    scenes::plate("wall", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}),
                    scenes::plate("below", {{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, -1}, {0.5, 0, -1}})};
  CHECK(faces_of(corner)[0] == 1);
}

// Files of other programs round coordinates, or leave a millimetre between what stands and what it stands on.
TEST_CASE("a wall whose foot is a little above or below a face cuts it as one that touches") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 7};
  for (int k = 0; k < 20; ++k) {
    Scene room = scenes::room_with_box();
    room.objects.resize(1);
    // The walls beside it are cut by what covers .47 of their height and is thinner than a fifth of that; heights and thicknesses keep away
    // from these limits by more than the gap, which makes walls higher or lower.
    const double at = 0.2 + 0.5 * random.uniform(), thick = 0.075 * random.uniform();
    const double top = random.uniform() < 0.2 ? 0.4 + 0.06 * random.uniform() : 0.48 + 0.42 * random.uniform();
    const bool sheet = k % 2 == 0;
    const auto with_foot = [&](double foot) {
      const auto plate = scenes::plate("wall", {{at, 0, foot}, {at, 1, foot}, {at, 1, top}, {at, 0, top}});
      Scene scene = room;
      scene.objects.push_back(sheet ? plate : scenes::object("wall", scenes::box({at, 0, foot}, {at + thick, 1, top})));
      return faces_of(scene);
    };
    const auto touching = with_foot(0.0);
    const double gap = std::pow(10.0, -12.0 + 9.0 * random.uniform());  // to a thousandth of the room
    CAPTURE(k, at, thick, top, gap);
    CHECK(touching[0] > 6);
    CHECK(with_foot(gap)[0] == touching[0]);
    CHECK(with_foot(-gap)[0] == touching[0]);
  }
}

TEST_CASE("closure: a plate in the plane of a wall, but beyond the wall, does not pass for lying on it") {
  // An L of unit arms, two high; the notch is x, y > 1. The plate lies in the plane of the wall y = 2.
  const auto plate_from = [](double x0, double x1) {
    Scene scene;
    scene.materials = {{"white", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{5.0}}};
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0},
                                          {0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {1, 1, 2}, {1, 2, 2}, {0, 2, 2}};
    std::vector<std::vector<std::uint32_t>> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (std::uint32_t i = 0; i < 6; ++i) { faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i}); }
    scene.objects = {scenes::object("room", raycast::Mesh::make(corners, faces).object, 0, true),
                     scenes::plate("lamp", {{x0, 2, 0.5}, {x1, 2, 0.5}, {x1, 2, 1.5}, {x0, 2, 1.5}}, 1)};
    const radiosity::Options options{.epsilon = 0.1, .min_area = 0.02, .audit_points = 0};
    radiosity::Outcome outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    return std::move(*outcome.solution);
  };
  // Rays look for losses where a room is not proven closed.
  const auto proven = [](const radiosity::Solution& solution) { return !solution.audit.stray && solution.audit.closure; };
  CHECK(proven(plate_from(0.2, 0.8)));
  CHECK(proven(plate_from(0.0, 1.0)));  // up to the borders of the wall
  CHECK_FALSE(proven(plate_from(0.8, 1.4)));
  CHECK_FALSE(proven(plate_from(0.2, 1.001)));
  // All of it behind the wall x = 1, or beyond the whole room: it is buried, and so is its light.
  for (const double x : {1.2, 2.2}) {
    const radiosity::Solution solution = plate_from(x, x + 0.6);
    CHECK_FALSE(proven(solution));
    for (const radiosity::SurfaceMean& surface : solution.audit.surfaces) { CHECK((surface.name == "lamp" || surface.radiosity.x == 0.0)); }
  }
}

TEST_CASE("an object much smaller than the scene is solved, or refused where its shape would be lost in rounding") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, uniform(-30.0, -1.0));
    // At the origin: it is the scene's other object that its coordinates are small beside.
    Scene scene;
    scene.materials = {{"white", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{5.0}}};
    scene.objects = {i % 2 == 0 ? scenes::object("small", raycast::Sphere::make({0, 0, 0}, size).object)
                                : scenes::object("small", scenes::box(glm::dvec3{-size}, glm::dvec3{size})),
                     scenes::plate("lamp", {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, 1)};
    INFO("size " << size);
    const radiosity::PrepareResult made = radiosity::prepare(scene);
    if (size > 1e-11) { CHECK(made.prepared); }
    if (size < 1e-13) { CHECK_FALSE(made.prepared); }
    if (!made.prepared) { CHECK_THAT(made.faults.at(0), Catch::Contains("'small' is smaller than 1e-12 of the scene")); }
  }
}
