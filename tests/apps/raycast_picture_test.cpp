// SPDX-License-Identifier: MIT
// The picture of the true objects beside that of the mesh.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/picture.hpp"
#include "apps/raycast_picture.hpp"

namespace {

using std::numbers::pi;

struct SolvedFile {
  apps::SceneFile file;
  radiosity::Solution solution;
};

SolvedFile solve(const std::string& text, double epsilon = 0.02) {
  apps::SceneResult parsed = apps::parse_scene(text);
  REQUIRE(parsed.file);
  radiosity::Options options;
  options.epsilon = epsilon;
  options.min_area = 1e-4;
  options.audit_points = 0;
  radiosity::Outcome outcome = radiosity::solve(parsed.file->scene, options);
  REQUIRE(outcome.solution);
  return {std::move(*parsed.file), std::move(*outcome.solution)};
}

std::string example_text(const std::string& name) {
  std::ifstream file(HALFLIGHT_SCENES "/" + name + ".scene");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

radiosity::Lookup lookup_of(const SolvedFile& solved) { return {solved.file.scene, solved.solution.mesh, solved.solution.frame}; }

}  // namespace

TEST_CASE("a point is seen in the direction of its place in the picture") {
  apps::Camera camera;
  camera.eye = {1.0, -2.0, 0.5};
  camera.forward = {0.3, 1.0, -0.2};
  camera.field_of_view = 70.0;
  const apps::View view = apps::make_view(camera, {320, 200});
  for (const double x : {0.0, 100.25, 320.0}) {
    for (const double y : {0.0, 33.0, 200.0}) {
      const glm::dvec3 p = view.to_view(view.eye + 3.0 * view.direction(x, y));
      CHECK(p.z == test::Approx(3.0));
      CHECK(std::abs(160.0 * (1.0 + p.x / p.z / view.half_width) - x) < 1e-10);
      CHECK(std::abs(100.0 * (1.0 + p.y / p.z / view.half_height()) - y) < 1e-10);
    }
  }
}

// Both draw the same radiosity at the same sample points, so a byte may differ by its rounding alone, but where a sample lies so near to
// an outline that the mesh picture, which snaps vertices to 1/4096 of a sample, puts it on the other side: outlines of a few picture
// sizes in length cross some thousand samples, each within 1/4096 with probability 2/4096. Allowed: 5 pixels, and in
// proportion to the samples on a line. Where four samples do for a pixel they do not span more than 4 levels, and the mean of a bent
// course between them is off by a fraction of that.
TEST_CASE("on plane objects the picture is that of the mesh") {
  const SolvedFile solved = solve(example_text("cornell"));
  const radiosity::Lookup lookup = lookup_of(solved);
  for (const unsigned samples : {1u, 4u}) {
    const std::uint32_t side = samples == 1 ? 300 : 150;
    const apps::View view = apps::make_view(solved.file.cameras.front(), {side, side});
    const apps::Picture mesh = apps::draw(solved.solution.mesh, view, 1.0, samples).value();
    const apps::Picture objects = apps::draw(lookup, view, 1.0, 0, samples).value();
    REQUIRE(mesh.rgb.size() == objects.rgb.size());
    std::size_t other = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < mesh.rgb.size(); i += 3) {
      int largest = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(int{mesh.rgb[i + c]} - int{objects.rgb[i + c]}));
        lit += mesh.rgb[i + c] > 30 ? 1 : 0;
      }
      other += largest > 1 ? 1 : 0;
    }
    INFO(samples * samples << " samples a pixel");
    CHECK(other <= 5 * samples);
    CHECK(lit > side * side);
  }
}

// A sphere of radius r at distance d is the cone of half-angle asin(r/d) about the direction of its centre. Each pixel has one sample, at
// its middle; where the picture and the cone do not agree, the middle's distance from the silhouette is the picture's error.
TEST_CASE("close up, the silhouette of a sphere is smooth: within half a pixel of the cone, where the mesh is off by many") {
  const SolvedFile solved = solve(
      "material lamp reflectance 0 emission 1\n"
      "sphere ball center 3 1 2 radius 0.5 material lamp\n"
      "camera rim eye -1 0 1 look 0 0 1 fov 50\n");
  const radiosity::Lookup lookup = lookup_of(solved);
  const glm::dvec3 centre{3.0, 1.0, 2.0};
  const glm::dvec3 eye{-1.0, 0.0, 1.0};
  const glm::dvec3 axis = glm::normalize(centre - eye);
  const double half_angle = std::asin(0.5 / glm::length(centre - eye));
  constexpr std::uint32_t side = 200;
  for (const double fov : {3.0, 0.5}) {
    double worst_objects = 0.0;
    double worst_mesh = 0.0;
    for (int turn = 0; turn < 7; ++turn) {
      // Looks at a point of the rim.
      const double angle = 2.0 * pi * turn / 7.0;
      const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3{0.0, 0.0, 1.0}));
      const glm::dvec3 v = glm::cross(axis, u);
      apps::Camera camera;
      camera.eye = eye;
      camera.forward = std::cos(half_angle) * axis + std::sin(half_angle) * (std::cos(angle) * u + std::sin(angle) * v);
      camera.field_of_view = fov;
      const apps::View view = apps::make_view(camera, {side, side});
      const double pixel = 2.0 * view.half_width / side;  // an angle, in the middle of so narrow a view
      const auto worst = [&](const apps::Picture& picture) {
        double result = 0.0;
        std::size_t lit = 0;
        for (std::uint32_t y = 0; y < side; ++y) {
          for (std::uint32_t x = 0; x < side; ++x) {
            const glm::dvec3 direction = view.direction(x + 0.5, y + 0.5);
            const double outside = std::atan2(glm::length(glm::cross(axis, direction)), glm::dot(axis, direction)) - half_angle;
            const bool seen = picture.pixel(x, y)[0] > 0;
            lit += seen ? 1 : 0;
            if (seen != (outside < 0.0)) { result = std::max(result, std::abs(outside) / pixel); }
          }
        }
        CHECK(lit > side * side / 4);
        CHECK(lit < 3 * side * side / 4);
        return result;
      };
      worst_objects = std::max(worst_objects, worst(apps::draw(lookup, view, 10.0, 0, 1).value()));
      worst_mesh = std::max(worst_mesh, worst(apps::draw(solved.solution.mesh, view, 10.0, 1).value()));
    }
    INFO("field of view " << fov << " degrees: objects " << worst_objects << ", mesh " << worst_mesh << " pixels");
    CHECK(worst_objects <= 0.5);
    CHECK(worst_mesh >= 3.0);
  }
}

TEST_CASE("the outline is as soft as its pixels are covered") {
  const SolvedFile solved = solve(
      "material lamp reflectance 0 emission 1\n"
      "sphere ball center 0 0 0 radius 1 material lamp\n");
  apps::Camera camera;
  camera.eye = {0.0, -10.0, 0.0};
  camera.forward = {0.0, 1.0, 0.0};
  camera.field_of_view = 20.0;
  const apps::View view = apps::make_view(camera, {40, 40});
  const apps::Picture picture = apps::draw(lookup_of(solved), view, pi, 0, 8).value();  // shows 1 as 1
  // The picture of the sphere is a disk of radius tan(asin(1/10)) on the plane at distance 1. Coverage by brute force.
  const double radius = std::tan(std::asin(0.1));
  for (std::uint32_t y = 0; y < 40; ++y) {
    for (std::uint32_t x = 0; x < 40; ++x) {
      int covered = 0;
      for (int k = 0; k < 64 * 64; ++k) {
        const glm::dvec3 r = view.ray(x + (k % 64 + 0.5) / 64, y + (k / 64 + 0.5) / 64);
        covered += std::hypot(r.x, r.y) < radius ? 1 : 0;
      }
      // A straight edge over an 8 x 8 grid is off by at most one sample in each of 8 rows; over 64 x 64 by one in 64.
      const double share = covered / 4096.0;
      CHECK(int{picture.pixel(x, y)[0]} >= int{apps::to_byte(std::max(0.0, share - 0.14))});
      CHECK(int{picture.pixel(x, y)[0]} <= int{apps::to_byte(std::min(1.0, share + 0.14))});
    }
  }
}

TEST_CASE("the picture does not depend on the threads, tells its progress and stops when asked to") {
  const SolvedFile solved = solve(example_text("room"), 0.1);
  const radiosity::Lookup lookup = lookup_of(solved);
  const apps::View view = apps::make_view(solved.file.cameras.front(), {160, 120});
  double last = 0.0;
  radiosity::Control control;
  control.progress = [&](std::string_view stage, double part) {
    CHECK(stage == "picture");
    CHECK(part > last);
    last = part;
  };
  const apps::Picture one = apps::draw(lookup, view, 1.0, 1, 4, control).value();
  CHECK(last == 1.0);
  CHECK(apps::draw(lookup, view, 1.0, 3).value().rgb == one.rgb);
  const std::atomic<bool> cancel = true;
  control.cancel = &cancel;
  CHECK_FALSE(apps::draw(lookup, view, 1.0, 2, 4, control));
}
