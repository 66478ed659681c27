// SPDX-License-Identifier: MIT

// The 95 % interval of an audited error holds the truth in 95 of 100 cases, on scenes whose radiosity is known exactly: a plate that
// reflects, lit by black lamps of every kind, so that B = rho M F with F by the contour (Lambert 1760) or by the inverse square law; and in
// closed rooms with things in them, where all that shines and reflects has the radiosity 1 however often light goes to and fro.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/surface_error.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Scene;

namespace {

constexpr double plate_rho = 0.5;
using ExactRadiosity = std::function<double(const glm::dvec3& x)>;  // radiosity of the plate

struct KnownScene {
  std::string name;
  Scene scene;
  ExactRadiosity exact;
};

// A rectangle_facing_down at the height z that faces down.
radiosity::Polygon rectangle_facing_down(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

double lit_by(const radiosity::Polygon& lamp, double exitance, const glm::dvec3& x) {
  return plate_rho * exitance * radiosity::point_to_polygon(x, {0, 0, 1}, lamp);
}

KnownScene random_known_scene(int kind, radiosity::Random& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const auto size = [&](double least, double most) { return least * std::pow(most / least, random.uniform()); };
  Scene scene{{{"plate", Color{plate_rho}, Color{0.0}},
               {"lamp", Color{0.0}, Color{1.0}},
               {"dim", Color{0.0}, Color{0.01}},
               {"black", Color{0.0}, Color{0.0}}},
              {}};
  scene.objects = {scenes::square("plate", {0, 0, 0}, 1.0, true)};
  const double x = between(-0.7, 0.7), y = between(-0.7, 0.7);
  switch (kind) {
    case 0: {  // a tilted quadrilateral, part of it perhaps below the horizon
      const double s = size(0.02, 1.0), tilt = between(-1.2, 1.2);
      const glm::dvec3 c{x, y, size(0.05, 2.0)}, a = s * glm::dvec3{std::cos(tilt), 0, std::sin(tilt)}, b{0, s, 0};
      const radiosity::Polygon lamp{c - a - b, c - a + b, c + a + b, c + a - b};
      scene.objects.push_back(scenes::plate("lamp", lamp, 1));
      return {"tilted lamp", std::move(scene), [lamp](const glm::dvec3& p) { return lit_by(lamp, 1.0, p); }};
    }
    case 1: {
      const double r = size(0.005, 0.3);
      const glm::dvec3 c{x, y, r + size(0.02, 1.0)};
      scene.materials[1].emission = Color{1.0 / (r * r)};
      scene.objects.push_back(scenes::object("lamp", raycast::Sphere::make(c, r).object, 1));
      return {"sphere lamp", std::move(scene), [c](const glm::dvec3& p) {
                const glm::dvec3 d = c - p;
                return plate_rho * d.z / std::pow(glm::dot(d, d), 1.5);
              }};
    }
    case 2: {  // a bright speck, and a large dim wall that touches the plate; the wall ends below the speck
      const double s = size(0.001, 0.1);
      scene.materials[1].emission = Color{0.05 / (s * s)};
      const radiosity::Polygon speck = rectangle_facing_down(x - s, y - s, x + s, y + s, 0.6),
                               wall{{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 0.5}, {-1, -1, 0.5}};
      scene.objects.push_back(scenes::plate("speck", speck, 1));
      scene.objects.push_back(scenes::plate("wall", wall, 2));
      const double bright = scene.materials[1].emission.x;
      return {"speck and wall", std::move(scene), [=](const glm::dvec3& p) { return lit_by(speck, bright, p) + lit_by(wall, 0.01, p); }};
    }
    default: {  // a lamp above a black screen with a hole, both parallel to the plate: what is seen of the lamp is a rectangle_facing_down
      const double hole = size(0.02, 0.3), z = between(0.3, 0.8), h = z + size(0.02, 0.5), s = size(0.1, 0.8);
      const double far = 4.0;
      const auto screen = [&](const char* name, double x0, double y0, double x1, double y1) {
        scene.objects.push_back(scenes::plate(name, rectangle_facing_down(x0, y0, x1, y1, z), 3));
      };
      screen("a", -far, -far, x - hole, far);
      screen("b", x + hole, -far, far, far);
      screen("c", x - hole, -far, x + hole, y - hole);
      screen("d", x - hole, y + hole, x + hole, far);
      scene.objects.push_back(scenes::plate("lamp", rectangle_facing_down(x - s, y - s, x + s, y + s, h), 1));
      return {"through a hole", std::move(scene), [=](const glm::dvec3& p) {
                const double k = h / z;  // the hole as the point p sees it in the plane of the lamp
                const auto far_x = [&](double at) { return p.x + k * (at - p.x); };
                const auto far_y = [&](double at) { return p.y + k * (at - p.y); };
                const double x0 = std::max(x - s, far_x(x - hole)), x1 = std::min(x + s, far_x(x + hole));
                const double y0 = std::max(y - s, far_y(y - hole)), y1 = std::min(y + s, far_y(y + hole));
                return x0 < x1 && y0 < y1 ? lit_by(rectangle_facing_down(x0, y0, x1, y1, h), 1.0, p) : 0.0;
              }};
    }
  }
}

// The relative L2 error of the mesh on the plate, by points in the cells of a grid on each triangle: every other surface is black and
// exact.
double true_mesh_error(const radiosity::Mesh& mesh, const ExactRadiosity& exact, int cells) {
  double square = 0.0, reference = 0.0;
  radiosity::Random random{3, 0};
  for (const radiosity::MeshFace& face : mesh.faces) {
    if (face.surface != 0) { continue; }
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const radiosity::MeshCorner* const c[3] = {&mesh.corners[face.first_corner], &mesh.corners[face.first_corner + k],
                                                 &mesh.corners[face.first_corner + k + 1]};
      const glm::dvec3 a = mesh.positions[c[0]->vertex], ab = mesh.positions[c[1]->vertex] - a, ac = mesh.positions[c[2]->vertex] - a;
      const double area = 0.5 * glm::length(glm::cross(ab, ac)) / (cells * cells);
      for (int i = 0; i < cells * cells; ++i) {
        const double root = std::sqrt((i % cells + random.uniform()) / cells), v = (i / cells + random.uniform()) / cells;
        const double u1 = root * (1.0 - v), u2 = root * v;
        const double shown = (1.0 - root) * c[0]->radiosity.x + u1 * c[1]->radiosity.x + u2 * c[2]->radiosity.x;
        const double truth = exact(a + u1 * ab + u2 * ac);
        square += area * (shown - truth) * (shown - truth);
        reference += area * truth * truth;
      }
    }
  }
  return std::sqrt(square / reference);
}

// How many of `seeds` intervals hold the true error of the solution's mesh, from about this many points each: of audits that end as they
// are, and of those that go on where they are wide.
struct Held {
  int once = 0, until_narrow = 0;
};
Held intervals_that_hold(const Scene& scene, double truth, const radiosity::Solution& solution, std::uint32_t points, int seeds) {
  auto result = radiosity::prepare(scene);
  REQUIRE(result.prepared);
  radiosity::DiscreteScene p{scene, 1, 1};
  p.take(std::move(*result.prepared));
  const radiosity::PathTracer tracer{scene, p.objects, p.surfaces};
  radiosity::Mesh mesh = solution.mesh;
  for (auto& at : mesh.positions) { at = (at - p.frame.centre) * p.frame.scale; }
  p.exposure.partly_buried.assign(solution.hierarchy.size(), false);
  p.exposure.area = solution.area;
  const auto measured_error = [&](std::uint64_t seed, std::uint64_t rays_if_wide) {
    radiosity::SurfaceErrorMeter meter{p, tracer, mesh, nullptr, seed};
    radiosity::SurfaceError measured;
    const bool complete = radiosity::measure_to_goal<radiosity::SurfaceError>(
        [&](std::uint64_t n, std::uint32_t paths, radiosity::SurfaceError& to) { return meter.measure(n, paths, 1, {}, to); },
        [](const radiosity::SurfaceError& e) -> const radiosity::ErrorSums& { return e.reconstructed; },
        {points, 300 * std::uint64_t{points}, {}, 0, 0, rays_if_wide}, measured);
    REQUIRE(complete);
    return measured.reconstructed.estimate();
  };
  const auto holds = [&](const std::optional<radiosity::ErrorEstimate>& error) {
    return error && error->low <= truth && truth <= error->high;
  };
  Held held;
  for (int k = 0; k < seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    const auto once = measured_error(seed, 0);
    held.once += holds(once);
    // Where the interval is narrow the audit with more rays is the same one.
    held.until_narrow += holds(once && !radiosity::is_wide(*once) ? once : measured_error(seed, 300 * std::uint64_t{points}));
  }
  return held;
}

}  // namespace

TEST_CASE("audit: of 240 intervals over 24 scenes of known radiosity at least 93 % hold the true error", "[slow]") {
  INFO("seed 71");
  radiosity::Random random{71, 0};
  constexpr int scenes_asked = 24, seeds = 10;
  int held = 0, until_narrow = 0;
  for (int k = 0; k < scenes_asked; ++k) {
    const KnownScene of = random_known_scene(k % 4, random);
    radiosity::Options options{.epsilon = 0.1, .min_area = 1e-3, .audit_points = 0, .threads = 1};
    const radiosity::Solution solution = scenes::solved(of.scene, options);
    const double truth = true_mesh_error(solution.mesh, of.exact, 32);
    // The figure is known: from a quarter of the points it is the same to .2 %.
    CHECK(true_mesh_error(solution.mesh, of.exact, 16) == test::Approx(truth).epsilon(0.004));
    const Held of_these = intervals_that_hold(of.scene, truth, solution, 2000, seeds);
    held += of_these.once;
    until_narrow += of_these.until_narrow;
  }
  CHECK(held >= static_cast<int>(0.93 * scenes_asked * seeds));
  CHECK(until_narrow >= static_cast<int>(0.93 * scenes_asked * seeds));
}

namespace {

// A closed room with boxes and spheres in it, some of them on its floor: each surface shines 1 - rho, so the radiosity is 1 everywhere.
Scene random_furnace(radiosity::Random& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  Scene furnace;
  const auto material = [&](double rho) {
    furnace.materials.push_back({"m" + std::to_string(furnace.materials.size()), Color{rho}, Color{1.0 - rho}});
    return static_cast<std::uint32_t>(furnace.materials.size() - 1);
  };
  const std::uint32_t walls = material(random.uniform() < 0.4 ? 0.99 : between(0.2, 0.95));
  furnace.objects = {scenes::object("room", raycast::BoxObject::make({0, 0, 0}, {3, 2, 2}).object, walls, true)};
  const bool on_floor = random.uniform() < 0.5;
  for (int i = 0; i < 3; ++i) {  // one in each third of the room
    const std::uint32_t own = material(between(0.1, 0.95));
    const glm::dvec3 size{between(0.1, 0.35), between(0.1, 0.6), between(0.1, 0.6)};
    const glm::dvec3 middle{i + 0.5, between(0.7, 1.3), on_floor && i != 1 ? size.z : between(0.7, 1.3)};
    if (i == 1) {
      furnace.objects.push_back(scenes::object("sphere", raycast::Sphere::make(middle, size.x).object, own));
    } else {
      furnace.objects.push_back(scenes::object("box", raycast::BoxObject::make(middle - size, middle + size).object, own));
    }
  }
  return furnace;
}

// Adds what is wrong to the corners of a mesh: a bump that may be small and high, and something else at each corner. The relative L2
// error that it has then where the radiosity is 1: what is linear between a triangle's corners is integrated exactly.
double spoil(radiosity::Mesh& mesh, const Scene& furnace, radiosity::Random& random) {
  const auto inputs = radiosity::surfaces(furnace);
  const glm::dvec3 middle = mesh.positions[static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.positions.size()))];
  const double width = 0.1 * std::pow(10.0, random.uniform()), height = 0.02 / width, elsewhere = 0.02 * random.uniform();
  for (radiosity::MeshCorner& corner : mesh.corners) {
    const double away = glm::length(mesh.positions[corner.vertex] - middle) / width;
    const double off = random.uniform() - 0.5;
    corner.radiosity = Color{1.0 + height * std::exp(-away * away) + elsewhere * off};
  }
  double square = 0.0, reference = 0.0;
  for (const radiosity::MeshFace& face : mesh.faces) {
    const double rho = furnace.materials[inputs[face.surface].material].reflectance.x;
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const radiosity::MeshCorner* const c[3] = {&mesh.corners[face.first_corner], &mesh.corners[face.first_corner + k],
                                                 &mesh.corners[face.first_corner + k + 1]};
      const glm::dvec3 a = mesh.positions[c[0]->vertex], ab = mesh.positions[c[1]->vertex] - a, ac = mesh.positions[c[2]->vertex] - a;
      const double area = 0.5 * glm::length(glm::cross(ab, ac));
      const glm::dvec3 off{c[0]->radiosity.x - 1.0, c[1]->radiosity.x - 1.0, c[2]->radiosity.x - 1.0};
      square += area / 6.0 * (glm::dot(off, off) + off.x * off.y + off.x * off.z + off.y * off.z);
      reference += area * rho * rho;
    }
  }
  return std::sqrt(square / reference);
}

}  // namespace

TEST_CASE("audit: of 240 intervals over 24 closed rooms with light to and fro at least 93 % hold the true error", "[slow]") {
  INFO("seed 72");
  radiosity::Random random{72, 0};
  constexpr int scenes_asked = 24, seeds = 10;
  int held = 0, until_narrow = 0;
  for (int k = 0; k < scenes_asked; ++k) {
    const Scene furnace = random_furnace(random);
    radiosity::Options options{.epsilon = 0.1, .min_area = 1e-3, .audit_points = 0, .threads = 1};
    radiosity::Solution solution = scenes::solved(furnace, options);
    const double truth = spoil(solution.mesh, furnace, random);
    const Held of_these = intervals_that_hold(furnace, truth, solution, 250, seeds);
    held += of_these.once;
    until_narrow += of_these.until_narrow;
  }
  CHECK(held >= static_cast<int>(0.93 * scenes_asked * seeds));
  CHECK(until_narrow >= static_cast<int>(0.93 * scenes_asked * seeds));
}
