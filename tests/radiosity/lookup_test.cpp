// SPDX-License-Identifier: MIT
// The radiosity on the true objects: which point of a triangle stands for a point of the surface, and what a ray sees.
#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/chord.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "scenes.hpp"

namespace {

using radiosity::Color;

radiosity::Solution solution(const radiosity::Scene& scene, double epsilon = 0.02) {
  const radiosity::Options options{.epsilon = epsilon, .min_area = 1e-3, .audit_points = 0};
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  return *outcome.solution;
}

// A room with a box, an egg (an unevenly scaled, turned sphere), a cylinder and a lamp in the ceiling.
radiosity::Scene room_with_curves() {
  radiosity::Scene scene = scenes::room_with_box();
  scene.objects.push_back(scenes::object("egg", raycast::Sphere::make({0, 0, 0}, 0.1).object));
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  scene.objects.back().placement.linear = glm::dmat3{{c, s, 0}, {-s, c, 0}, {0, 0, 1}} * glm::dmat3{{1, 0, 0}, {0, 0.5, 0}, {0, 0, 2}};
  scene.objects.back().placement.translation = {0.75, 0.7, 0.55};
  scene.objects.push_back(scenes::object("post", raycast::Cylinder::make({0.8, 0.25, 0.0}, {0.05, 0, 0.4}, 0.12).object));
  return scene;
}

// The solution's mesh with other colours: one a vertex, from a function of its position.
radiosity::Mesh painted(radiosity::Mesh mesh, const std::function<Color(const glm::dvec3&)>& paint) {
  for (radiosity::MeshCorner& corner : mesh.corners) { corner.radiosity = paint(mesh.positions[corner.vertex]); }
  return mesh;
}

// A colour that knows nothing of its neighbour's: 0 to 1.
Color noise(const glm::dvec3& p) {
  const double x = std::sin(12.9898 * p.x + 78.233 * p.y + 37.719 * p.z) * 43758.5453;
  return Color{x - std::floor(x)};
}

std::size_t first_input(const std::vector<radiosity::InputSurface>& inputs, const std::string& name) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].name == name) { return i; }
  }
  FAIL("no surface " << name);
  return 0;
}

}  // namespace

TEST_CASE("a chord point is exact at the corners, the foot of the perpendicular on a plane, and undoes the prism") {
  constexpr std::uint64_t seed = 5;
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return glm::dvec3{uniform(random), uniform(random), uniform(random)}; };
  for (int i = 0; i < 2000; ++i) {
    // Three points near one another on the unit sphere, the normals at most 0.2 rad away from radial.
    radiosity::ChordTriangle t;
    const glm::dvec3 centre = glm::normalize(vector());
    for (std::size_t k = 0; k < 3; ++k) {
      t.position[k] = glm::normalize(centre + 0.3 * vector());
      t.normal[k] = glm::normalize(t.position[k] + 0.1 * vector());
    }
    const glm::dvec3 cross = glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]);
    // No needles, and none that stands on edge: the normals must point to its air side.
    if (!(std::abs(glm::dot(cross, centre)) > 0.5 * glm::length(cross)) || glm::length(cross) < 0.01) { continue; }
    if (glm::dot(cross, centre) < 0.0) {
      std::swap(t.position[1], t.position[2]);
      std::swap(t.normal[1], t.normal[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = radiosity::chord_point(t, t.position[k]);
      REQUIRE(corner);
      CHECK(std::abs(corner->weight[static_cast<int>(k)] - 1.0) < 1e-12);
      CHECK(std::abs(corner->offset) < 1e-12);
    }
    // Weights and an offset of a few chord errors go in and come out. Doubles lose 1e-16 of the position, which is at most
    // 1e-16 / 0.01 of a triangle whose area is 0.005; 1e-11 leaves room for the slant of the normals.
    const double u = 0.5 * (uniform(random) + 1.0);
    const double v = 0.5 * (uniform(random) + 1.0);
    const glm::dvec3 w = {1.0 - std::max(u, v), std::min(u, v), std::abs(u - v)};
    // Over the offset the normals, which differ by 0.6 at most, must not turn the triangle over: 0.6 s is well below its altitude.
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) { longest = std::max(longest, glm::length(t.position[(k + 1) % 3] - t.position[k])); }
    const double s = 0.3 * uniform(random) * glm::length(cross) / longest;
    glm::dvec3 x{0.0};
    for (std::size_t k = 0; k < 3; ++k) { x += w[static_cast<int>(k)] * (t.position[k] + s * t.normal[k]); }
    const auto found = radiosity::chord_point(t, x);
    REQUIRE(found);
    CHECK(glm::length(found->weight - w) < 1e-11);
    CHECK(std::abs(found->offset - s) < 1e-11);

    // On a plane all normals are that of the triangle.
    const glm::dvec3 normal = glm::normalize(glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]));
    t.normal = {normal, normal, normal};
    const glm::dvec3 foot = w.x * t.position[0] + w.y * t.position[1] + w.z * t.position[2];
    const auto flat = radiosity::chord_point(t, foot + uniform(random) * normal);
    REQUIRE(flat);
    CHECK(glm::length(flat->weight - w) < 1e-11);
  }
  CHECK_FALSE(radiosity::chord_point({{glm::dvec3{0.0}, glm::dvec3{1.0}, glm::dvec3{2.0}}, {}}, glm::dvec3{0.5}));
}

TEST_CASE("no point of a triangle is nearer than the nearest one") {
  constexpr std::uint64_t seed = 6;
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return glm::dvec3{uniform(random), uniform(random), uniform(random)}; };
  for (int i = 0; i < 500; ++i) {
    std::array<glm::dvec3, 3> p = {vector(), vector(), vector()};
    if (i % 10 == 0) { p[2] = 0.3 * p[0] + 0.7 * p[1]; }  // no area
    const glm::dvec3 x = 2.0 * vector();
    const auto distance = [&](const glm::dvec3& w) { return glm::length(w.x * p[0] + w.y * p[1] + w.z * p[2] - x); };
    const glm::dvec3 w = radiosity::nearest_in_triangle(p, x);
    CHECK(std::min({w.x, w.y, w.z}) >= 0.0);
    CHECK(std::abs(w.x + w.y + w.z - 1.0) < 1e-15);
    for (int a = 0; a <= 20; ++a) {
      for (int b = 0; b <= 20 - a; ++b) { CHECK(distance(w) <= distance({a / 20.0, b / 20.0, 1.0 - (a + b) / 20.0}) + 1e-12); }
    }
  }
}

TEST_CASE("the lookup is exact at the vertices of the mesh") {
  const radiosity::Scene scene = room_with_curves();
  const radiosity::Solution solved = solution(scene);
  const radiosity::Mesh mesh = painted(solved.mesh, noise);
  const radiosity::Lookup lookup(scene, mesh, solved.frame);
  const auto inputs = radiosity::surfaces(scene);
  std::size_t corners = 0;
  for (const radiosity::MeshFace& face : mesh.faces) {
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + k];
      const glm::dvec3 p = (mesh.positions[corner.vertex] - solved.frame.centre) * solved.frame.scale;
      const auto color = lookup.at(inputs[face.surface].object, inputs[face.surface].sheet, p);
      REQUIRE(color);
      // A position is known to 1e-16; the smallest triangle is above 1e-3 across.
      CHECK(std::abs(color->x - corner.radiosity.x) < 1e-11);
      ++corners;
    }
  }
  CHECK(corners > 3000);
}

// Where a point x of the surface is a point p of the chord plus an offset s along n, a linear field of gradient g differs by g.n s:
// nothing on a plane, and on a curved sheet at most |g| times the chord error, which for the first approximation is 0.01 of the size
// of the object's box and sinks by refinement.
TEST_CASE("a linear field comes back: exactly on planes, within the chord error on curved sheets") {
  const radiosity::Scene scene = room_with_curves();
  const radiosity::Solution solved = solution(scene);
  const glm::dvec3 gradient{1.0, 0.5, -0.25};
  const auto field = [&](const glm::dvec3& p) { return Color{glm::dot(gradient, p)}; };
  const radiosity::Lookup lookup(scene, painted(solved.mesh, field), solved.frame);
  const raycast::Scene objects = radiosity::compile(scene, solved.frame);
  std::mt19937_64 random{3};
  INFO("seed 3");
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::size_t seen = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double z = 2.0 * uniform(random) - 1.0;
    const double angle = 6.283185307179586 * uniform(random);
    const glm::dvec3 direction{std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z};
    const glm::dvec3 eye{0.15, 0.8, 0.5};
    const auto hit = objects.closest({(eye - solved.frame.centre) * solved.frame.scale, direction});
    REQUIRE(hit);  // the room is closed
    const auto color = lookup.seen(eye, direction);
    REQUIRE(color);
    const glm::dvec3 point = eye + hit->t / solved.frame.scale * direction;
    const raycast::PlacedObject& object = objects.object(hit->object);
    const raycast::Box box = object.bounds();
    const bool plane = object.flat() || hit->sheet > 0;  // caps, too
    const double chord_error = 0.01 * glm::length(box.hi - box.lo) / solved.frame.scale;
    // The sliver of a cap beyond the chord of its rim is as wide as the chord error.
    const double tolerance = object.flat() ? 1e-12 : glm::length(gradient) * chord_error;
    CHECK(std::abs(color->x - glm::dot(gradient, point)) <= tolerance);
    seen += plane ? 0 : 1;
  }
  CHECK(seen > 200);
}

// Noise at the vertices, so that every wrong triangle shows. Between two points of a path at distance d the colour may change by
// d / altitude of the triangle (its range is 1), altitude the smallest of all; a jump at a seam would be some tenths.
TEST_CASE("the lookup is continuous over a curved sheet") {
  const radiosity::Scene scene = room_with_curves();
  const radiosity::Solution solved = solution(scene);
  const radiosity::Mesh mesh = painted(solved.mesh, noise);
  const radiosity::Lookup lookup(scene, mesh, solved.frame);
  const auto inputs = radiosity::surfaces(scene);
  const raycast::Scene objects = radiosity::compile(scene, solved.frame);
  for (const char* name : {"egg", "post.side"}) {
    const std::size_t input = first_input(inputs, name);
    const std::uint32_t object = inputs[input].object;
    const std::uint32_t sheet = inputs[input].sheet;
    double altitude = std::numeric_limits<double>::infinity();
    std::size_t triangles = 0;
    for (const radiosity::MeshFace& face : mesh.faces) {
      if (face.surface != input) { continue; }
      for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k, ++triangles) {
        std::array<glm::dvec3, 3> p = {glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};
        const std::array<std::uint32_t, 3> corner = {0, k, k + 1};
        for (std::size_t j = 0; j < 3; ++j) {
          p[j] = (mesh.positions[mesh.corners[face.first_corner + corner[j]].vertex] - solved.frame.centre) * solved.frame.scale;
        }
        const double area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (std::size_t j = 0; j < 3; ++j) { altitude = std::min(altitude, area / glm::length(p[(j + 1) % 3] - p[j])); }
      }
    }
    REQUIRE(triangles > 100);
    const raycast::Box box = objects.object(object).bounds();
    const glm::dvec3 half = 0.5 * box.size();
    constexpr int steps = 400'000;
    double last = 0.0;
    double worst = 0.0;
    double change = 0.0;
    glm::dvec3 before{0.0};
    for (int i = 0; i <= steps; ++i) {
      // A curve that winds about the object ten times on its way from one end to the other; on the cylinder it stays off the caps.
      const double t = static_cast<double>(i) / steps;
      const glm::dvec3 around{std::cos(63.0 * t), std::sin(63.0 * t), 1.7 * t - 0.85};
      const glm::dvec3 p = objects.object(object).project(sheet, box.centre() + half * around).position;
      const auto color = lookup.at(object, sheet, p);
      REQUIRE(color);
      const double step = glm::length(p - before);
      if (i > 0) {
        worst = std::max(worst, std::abs(color->x - last) * altitude / step);
        change = std::max(change, std::abs(color->x - last));
      }
      last = color->x;
      before = p;
    }
    INFO(name << ": largest change in a step " << change << ", slope " << worst);
    CHECK(worst <= 1.1);  // the prism widens the triangle by the offset times the curvature, a few percent
    CHECK(worst > 0.01);  // the colours do change
  }
}

TEST_CASE("backs do not hide, fronts do, and what is buried is not seen") {
  radiosity::Scene scene;
  scene.materials = {
      {"grey", Color{0.0}, Color{1.0}}, {"red", Color{0.0}, Color{2.0, 0.0, 0.0}}, {"blue", Color{0.0}, Color{0.0, 0.0, 3.0}}};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {4, 4, 4}), 0, true),
                   scenes::object("ball", raycast::Sphere::make({2, 2, 0}, 1.0).object, 1),                    // half of it below the floor
                   scenes::object("plate", scenes::polygon({{1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2}}), 2),  // faces up
                   scenes::object("crate", scenes::box({0, 0, 3}, {1, 1, 4}), 1)};                             // fills a corner
  const radiosity::Solution solved = solution(scene);
  const radiosity::Lookup lookup(scene, solved.mesh, solved.frame);
  const auto seen = [&](const glm::dvec3& eye, const glm::dvec3& target) { return lookup.seen(eye, target - eye); };
  const Color grey{1.0};
  const Color red{2.0, 0.0, 0.0};
  const Color blue{0.0, 0.0, 3.0};
  CHECK(seen({2, 2, 9}, {2, 2, 0}) == blue);           // through the back of the ceiling
  CHECK(seen({2, 2, 1.5}, {2, 2, 3}) == grey);         // through the back of the plate, to the ceiling
  CHECK(seen({2, 2, 1.5}, {2, 2, 0}) == red);          // the ball hides the floor
  CHECK(seen({2, 2, -9}, {2.1, 2, 4}) == grey);        // from below: the ball's lower half is buried, the ceiling is seen
  CHECK(seen({2, 2, 0.2}, {2, 2, 0.3}) == grey);       // out of the ball: its back, the plate's back
  CHECK(seen({-3, 0.5, 3.5}, {3, 0.5, 3.5}) == grey);  // the crate's side that lies on the wall is buried, its other ones are backs
  CHECK(seen({3, 0.5, 3.5}, {0, 0.5, 3.5}) == red);
  CHECK_FALSE(seen({9, 9, 9}, {20, 9, 9}));
  CHECK_FALSE(lookup.seen({2, 2, 9}, glm::dvec3{0.0}));
}

TEST_CASE("what is seen does not depend on where the scene lies nor on its size") {
  const radiosity::Scene scene = room_with_curves();
  const radiosity::Solution solved = solution(scene, 0.1);
  const radiosity::Lookup lookup(scene, solved.mesh, solved.frame);
  std::mt19937_64 random{9};
  INFO("seed 9");
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto compare = [&](double scale, const glm::dvec3& offset, double tolerance) {
    const radiosity::Scene other = scenes::moved(scene, scale, offset);
    const radiosity::Solution other_solved = solution(other, 0.1);
    const radiosity::Lookup other_lookup(other, other_solved.mesh, other_solved.frame);
    const glm::dvec3 eye{0.2, 0.2, 0.7};
    std::size_t wrong = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 direction{uniform(random), uniform(random), uniform(random)};
      const auto a = lookup.seen(eye, direction);
      const auto b = other_lookup.seen(eye * scale + offset, direction);
      if (!a || !b || !(glm::length(*a - *b) <= tolerance)) { ++wrong; }
    }
    return wrong;
  };
  CHECK(compare(0x1p20, glm::dvec3{0.0}, 0.0) == 0);
  CHECK(compare(0x1p-20, glm::dvec3{0.0}, 0.0) == 0);
  // Coordinates of 1e5 are known to 1e-11; a ray may pass on the other side of an outline.
  CHECK(compare(1.0, {1e5, -1e5, 1e5}, 1e-6) <= 1);
}
