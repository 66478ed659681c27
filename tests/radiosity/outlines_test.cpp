// SPDX-License-Identifier: MIT

// Outlines of curved objects in pictures of meshes (picture/outlines.hpp), against rays through every point of the picture.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>

#include <raycast/objects/cone.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/outlines.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;

// Something round above a floor, a quarter of its size deep in it or up in the air, under a lamp.
radiosity::Scene round_on_floor(int kind, std::uint64_t seed) {
  radiosity::Random random{seed, static_cast<std::uint64_t>(kind)};
  const auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  const glm::dvec3 at{uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(0.3, 0.6)};
  const glm::dvec3 axis{uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(0.4, 0.6)};
  std::shared_ptr<const raycast::Object> shape = raycast::Sphere::make(at, uniform(0.3, 0.5)).object;
  if (kind == 1) { shape = raycast::Cylinder::make(at, axis, uniform(0.2, 0.4)).object; }
  if (kind == 2) { shape = raycast::Cone::make(at, axis, uniform(0.2, 0.4), 0.0).object; }
  if (kind == 3) { shape = raycast::Torus::make(at, axis, 0.35, uniform(0.1, 0.2)).object; }
  radiosity::Scene scene{{{"white", Color{0.6}, Color{0.0}}, {"dark", Color{0.2, 0.3, 0.4}, Color{0.0}}, {"lamp", Color{0.0}, Color{10.0}}},
                         {}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 2.0, true, 1), scenes::object("thing", shape, 0),
                   scenes::square("lamp", {0.4, 0.3, 3.0}, 0.5, false, 2)};
  return scene;
}

// A camera without borders that looks from a point to another.
struct Pinhole {
  glm::dvec3 eye{0.0}, forward{0.0}, right{0.0}, up{0.0};
  Pinhole(const glm::dvec3& from, const glm::dvec3& to) : eye{from}, forward{glm::normalize(to - from)} {
    right = glm::normalize(glm::cross(forward, glm::dvec3{0, 0, 1}));
    up = glm::cross(right, forward);
  }
  [[nodiscard]] radiosity::Viewpoint viewpoint(double pixel) const {
    return {eye,
            [*this](const glm::dvec3& p, const glm::dvec3& n) {
              const double ahead = glm::dot(p - eye, forward);
              return std::max(0.0, glm::dot(n, eye - p)) / (ahead * ahead * ahead);
            },
            pixel};
  }
};

// The surface that the facets of one object show along a ray from the eye, if any.
struct FacetHit {
  std::uint32_t sheet = 0;
  glm::dvec3 point{0.0};
};
std::optional<FacetHit> hit_facets(const radiosity::Surface& surface,
                                   const std::vector<std::pair<std::uint32_t, radiosity::Polygon>>& facets, const glm::dvec3& eye,
                                   const glm::dvec3& direction) {
  std::optional<FacetHit> best;
  double nearest = 1e300;
  for (const auto& [sheet, corners] : facets) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const glm::dvec3 a = corners[k] - corners[0], b = corners[k + 1] - corners[0], n = glm::cross(a, b);
      const double along = glm::dot(n, direction);
      if (!(along < 0.0)) { continue; }
      const double t = glm::dot(n, corners[0] - eye) / along;
      const glm::dvec3 p = eye + t * direction - corners[0];
      const double u = glm::dot(glm::cross(p, b), n), v = glm::dot(glm::cross(a, p), n), all = glm::dot(n, n);
      if (!(t > 0.0) || u < 0.0 || v < 0.0 || u + v > all || !(t < nearest)) { continue; }
      nearest = t;
      best = FacetHit{sheet, surface.object->project(sheet, eye + t * direction).position};
    }
  }
  return best;
}

// What rays through a fine grid find: squared differences where facets show another surface than the objects, integrated over the picture.
double error_by_rays(const radiosity::FinalGather& light, const std::vector<radiosity::Surface>& surfaces, const Pinhole& camera,
                     double half_width, int side) {
  std::vector<std::pair<std::uint32_t, radiosity::Polygon>> facets;
  for (const brep::FaceId f : brep::faces(surfaces[1].brep)) {
    facets.emplace_back(surfaces[1].brep.data(f).sheet, radiosity::corner_polygon(surfaces[1].brep, f));
  }
  const radiosity::FinalGather::Eye eye = light.eye(camera.eye);
  double sum = 0.0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double s = ((x + 0.5) / side * 2.0 - 1.0) * half_width, t = ((y + 0.5) / side * 2.0 - 1.0) * half_width;
      const glm::dvec3 direction = camera.forward + s * camera.right + t * camera.up;
      const auto truth = light.seen16(eye, std::array{direction}, true)[0];
      const auto facet = hit_facets(surfaces[1], facets, eye.position, direction);
      const std::uint32_t of_truth = truth && truth->object == 1 ? truth->surface : radiosity::no_node;
      const std::uint32_t of_facet = facet ? surfaces[1].first_surface + facet->sheet : radiosity::no_node;
      if (of_truth == of_facet) { continue; }
      Color shown{0.0};
      if (facet) {
        const auto point = surfaces[1].object->project(facet->sheet, facet->point);
        shown = light.solved({point, 1, of_facet}).value_or(Color{0.0});
      } else {  // the floor, or nothing
        const glm::dvec3 floor = (glm::dvec3{0.0} - light.frame().centre) * light.frame().scale;
        const glm::dvec3 p = eye.position + (floor.z - eye.position.z) / direction.z * direction;
        const glm::dvec3 from_middle = (p - floor) / light.frame().scale;
        const bool on = direction.z < 0.0 && std::max(std::abs(from_middle.x), std::abs(from_middle.y)) < 2.0;
        if (on) { shown = light.solved({{p, {0, 0, 1}}, 0, 0}).value_or(Color{0.0}); }
      }
      const Color off = shown - (truth ? light.solved(*truth).value_or(Color{0.0}) : Color{0.0});
      sum += glm::dot(off, off);
    }
  }
  const double width = 2.0 * half_width / side * light.frame().scale;
  return sum * width * width;
}

}  // namespace

TEST_CASE("what is wrong at outlines is what rays through the picture find", "[mesh][accuracy]") {
  const std::uint64_t seed = 0x6f75746c;
  double all_found = 0.0, all_true = 0.0;
  for (int kind = 0; kind < 4; ++kind) {
    for (std::uint64_t k = 0; k < 2; ++k) {
      CAPTURE(seed, kind, k);
      const radiosity::Scene scene = round_on_floor(kind, seed + k);
      const radiosity::Options options{.epsilon = 0.03, .audit_points = 0};
      const radiosity::Solution solution = scenes::solved(scene, options);
      const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
      const std::vector<radiosity::Surface> surfaces = scenes::boundaries(light.objects());
      radiosity::Random random{seed + k, static_cast<std::uint64_t>(kind), 1};
      const double angle = 6.283 * random.uniform();
      const Pinhole camera{{3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.5 + 2.0 * random.uniform()}, {0.0, 0.0, 0.5}};
      double found = 0.0;
      for (const auto& of : radiosity::outline_errors(light, surfaces, camera.viewpoint(0.0), 1)) {
        for (const double error : of) { found += error; }
      }
      const double truth = error_by_rays(light, surfaces, camera, 0.5, 300);
      REQUIRE(truth > 0.0);
      all_found += found;
      all_true += truth;
    }
  }
  // The light on both sides of an edge is looked at in two points: where it is dim or changes, the square of a single case may be off by
  // half, in the mean by a third, and the sum of eight by a third over the square root of eight.
  CHECK(all_found == test::Approx(all_true).epsilon(0.15));
}

TEST_CASE("a strip over pixels: the mean of its squared parts over all places") {
  const std::uint64_t seed = 77;
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  for (int i = 0; i < 20; ++i) {
    const double width = std::pow(10.0, -2.0 + 3.0 * random.uniform());
    CAPTURE(width);
    constexpr int places = 20000;
    double sum = 0.0;
    for (int k = 0; k < places; ++k) {
      const double from = (k + 0.5) / places, to = from + width;
      for (int pixel = 0; pixel < to; ++pixel) {
        const double part = std::max(0.0, std::min(to, pixel + 1.0) - std::max(from, static_cast<double>(pixel)));
        sum += part * part / places;
      }
    }
    CHECK(radiosity::strip_in_pixels(width) == test::Approx(sum).epsilon(1e-4));
  }
}

TEST_CASE("a mesh for a camera is refined at its outlines until they are as good as was asked for", "[mesh][accuracy]") {
  const radiosity::Scene scene = round_on_floor(0, 5);
  radiosity::Options options{.epsilon = 0.05, .mesh_error = 0.02, .audit_points = 0};
  radiosity::Control control;
  control.viewpoint = Pinhole{{3.0, 0.5, 1.2}, {0.0, 0.0, 0.5}}.viewpoint(1e-6);
  options.threads = 1;
  const radiosity::Solution one = scenes::solved(scene, options, control);
  REQUIRE(one.refined);
  const radiosity::MeshRefinement& mesh = *one.audit.mesh;
  CHECK(mesh.met);
  CHECK(mesh.outlines_before > 0.02);  // else the test says nothing
  CHECK(mesh.outlines_after < 0.02);
  CHECK(mesh.after.relative_l2 <= 0.02);
  CHECK(mesh.after.relative_l2 >= mesh.outlines_after);
  options.threads = 3;
  const radiosity::Solution three = scenes::solved(scene, options, control);
  CHECK((three.refined->positions == one.refined->positions));  // not to be printed
  CHECK(three.audit.mesh->outlines_after == mesh.outlines_after);
  control.viewpoint.reset();
  CHECK(scenes::solved(scene, options, control).audit.mesh->outlines_before == 0.0);
}
