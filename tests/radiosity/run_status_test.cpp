// SPDX-License-Identifier: MIT

// What a run says became of it agrees with what its own audit found.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::RunStatus;

namespace {

// A superquadric that is almost a cylinder: its profile has so sharp an edge that its patches show hardly anything of how it bends there.
radiosity::Scene sharp_in_room(double radius) {
  radiosity::Scene scene;
  scene.materials = {{"wall", Color{0.6}, Color{0.0}}, {"thing", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{20.0}}};
  scene.objects = {scenes::object("room", scenes::box({-2, -2, -2}, {2, 2, 2}), 0, true),
                   scenes::object("thing", raycast::Superquadric::make({0, 0, 0}, glm::dvec3{radius}, 0.001, 1.0).object, 1),
                   scenes::plate("lamp", {{-0.5, -0.5, 1.99}, {-0.5, 0.5, 1.99}, {0.5, 0.5, 1.99}, {0.5, -0.5, 1.99}}, 2)};
  return scene;
}

radiosity::Scene ball_over_plate(radiosity::Random& random) {
  radiosity::Scene scene = scenes::two_plates(0.05 + 0.9 * random.uniform());
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({"ball", Color{0.3 + 0.6 * random.uniform()}, Color{0.0}});
  const double radius = 0.05 + 0.2 * random.uniform();
  scene.objects.push_back({"ball", raycast::Sphere::make({random.uniform(), random.uniform(), radius}, radius).object, {}, {material}});
  return scene;
}

}  // namespace

TEST_CASE("a run that has converged is not contradicted by its own audit: by a target, or without one by three times the estimate",
          "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int converged[2] = {0, 0}, refuted = 0;
  for (int k = 0; k < 48; ++k) {  // an eighth are rooms by threshold, of which more than half are refuted
    const radiosity::Scene scene = k % 4 == 0 ? sharp_in_room(0.6 + 0.4 * random.uniform()) : ball_over_plate(random);
    const bool by_target = k % 8 >= 4;
    radiosity::Options options{.threads = 1, .seed = k + std::uint64_t{seed}};
    options.audit_points = k % 3 == 0 ? 1000 : 200;
    if (by_target) {
      options.refinement = radiosity::Refinement::a_posteriori;
      options.target = std::pow(10.0, -1.5 + random.uniform());
    } else {
      options.epsilon = std::pow(10.0, -2.0 + random.uniform());
      options.min_area = 0.01 * options.epsilon;
    }
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    const RunStatus status = audit.status();
    CAPTURE(k, by_target, options.target, options.epsilon, name(status));
    CHECK((status == RunStatus::converged) == (audit.converged && !audit.far_off() && !audit.error_unknown()));
    bool larger = false;  // is an error more than three times its estimate?
    const auto compare = [&](const std::optional<double>& estimate, const std::optional<radiosity::ErrorEstimate>& error) {
      if (!estimate || !error) { return; }
      CAPTURE(*estimate, error->relative_l2, error->low, error->high);
      if (audit.converged && !by_target) { CHECK(error->low <= 3.0 * *estimate); }
      larger = larger || error->relative_l2 > 3.0 * *estimate;
    };
    compare(audit.estimated_error, audit.surface_error);
    compare(audit.estimated_leaf_error, audit.leaf_error);
    if (by_target && audit.converged && audit.surface_error) { CHECK(audit.surface_error->low <= options.target); }
    if (status == RunStatus::estimate_refuted) { CHECK((larger && !by_target)); }
    converged[by_target] += audit.converged ? 1 : 0;
    refuted += status == RunStatus::estimate_refuted ? 1 : 0;
  }
  CAPTURE(converged[0], converged[1], refuted);
  CHECK(converged[0] > 0);
  CHECK(converged[1] > 0);
  CHECK(refuted > 0);
}

TEST_CASE("a run has not converged if path tracing found a quarter of the light of surfaces or picture wrong, and more than asked for") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 1};
  int far_off = 0;
  for (int k = 0; k < 200; ++k) {
    radiosity::Audit audit;
    audit.asked = k % 2 == 0 ? 0.0 : random.uniform();
    double most = 0.0;
    const auto error = [&] {
      const double low = random.uniform() * random.uniform();
      most = std::max(most, low);
      return radiosity::ErrorEstimate{1.1 * low, 0.1 * low, low, 1.2 * low};
    };
    if (k % 3 != 0) { audit.surface_error = error(); }
    if (k % 3 != 1) { audit.leaf_error = error(); }
    if (k % 5 != 0) { audit.picture_error.emplace().error = error(); }
    CAPTURE(k, most, audit.asked);
    CHECK((audit.status() == RunStatus::far_off) == (most > std::max(0.25, audit.asked)));
    far_off += audit.far_off() ? 1 : 0;
  }
  radiosity::Audit dim;  // whose picture is too noisy to tell its error, but wrong all over
  dim.picture_error.emplace();
  dim.picture_error->error = {1.0, 2.0, 0.0, 4.0};
  dim.picture_error->over8 = {0.7, 1.0};
  CHECK(dim.status() == RunStatus::far_off);
  dim.picture_error->over8 = {0.4, 1.0};
  CHECK(dim.status() == RunStatus::converged);
  dim.picture_error->over8 = {0.7, 1.0};
  dim.picture_error->error = {0.1, 0.01, 0.08, 0.12};  // known to be small
  CHECK(dim.status() == RunStatus::converged);
  radiosity::Audit dark;  // in which hardly any path meets light
  dark.estimated_error = 0.6;
  dark.surface_error = radiosity::ErrorEstimate{0.3, 0.5, 0.0, 0.8};
  CHECK(dark.status() == RunStatus::error_unknown);
  dark.surface_error->high = 0.4;
  CHECK(dark.status() == RunStatus::converged);
  CHECK(far_off > 20);
  CHECK(far_off < 180);
}
