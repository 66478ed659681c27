// SPDX-License-Identifier: MIT
// An object that has nothing but the four methods a user must write is a member like any other: the solution, its audit and what is seen of
// it are those of the library's own ball.
#include "catch.hpp"

#include <cmath>
#include <optional>

#include <brep/builder_input.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "scenes.hpp"

namespace {

class OwnBall final : public raycast::Object {
 public:
  OwnBall(const glm::dvec3& centre, double radius) : ball_(raycast::Sphere::make(centre, radius).object) {}
  [[nodiscard]] raycast::Box bounds() const override { return ball_->bounds(); }
  void spans(const raycast::Segment& line, raycast::Spans& out) const override { ball_->spans(line, out); }
  void approximate(double tolerance, brep::Builder& out) const override { ball_->approximate(tolerance, out); }
  [[nodiscard]] raycast::SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return ball_->project(sheet, p); }

 private:
  std::shared_ptr<const raycast::Object> ball_;
};

}  // namespace

TEST_CASE("an object of the user's own with four methods is lit, shades, is audited and is seen as the library's own") {
  const glm::dvec3 centre{0.7, 0.6, 0.5};
  const double radius = 0.15;
  std::optional<radiosity::Solution> solutions[2];
  std::optional<radiosity::Lookup> lookups[2];
  for (int own = 0; own < 2; ++own) {
    radiosity::Scene scene = scenes::room_with_box();
    std::shared_ptr<const raycast::Object> ball = raycast::Sphere::make(centre, radius).object;
    if (own) { ball = std::make_shared<const OwnBall>(centre, radius); }
    scene.objects.push_back(scenes::object("ball", ball));
    const radiosity::Options options{.epsilon = 0.05, .min_area = 2e-3, .audit_points = 2000};
    const radiosity::Outcome outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    solutions[own] = *outcome.solution;
    lookups[own].emplace(scene, solutions[own]->mesh, solutions[own]->frame);
  }
  // The library knows of its ball that it is convex, so it may refine a little otherwise: both are right within their own error, some
  // per cent at this coarse setting.
  const auto& of = solutions[0]->audit.surfaces;
  REQUIRE(of.size() == solutions[1]->audit.surfaces.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    INFO(of[i].name);
    CHECK(solutions[1]->audit.surfaces[i].radiosity.x == test::Approx(of[i].radiosity.x).epsilon(0.03).margin(1e-3));
  }
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.1 * i, tilt = 0.02 * (i % 20);
    const glm::dvec3 eye{0.1, 0.1, 0.9};
    const glm::dvec3 direction = centre + radius * glm::dvec3{std::cos(angle), std::sin(angle), tilt} - eye;
    const auto a = lookups[0]->seen(eye, direction), b = lookups[1]->seen(eye, direction);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) { continue; }
    ++seen;
    CHECK(b->x == test::Approx(a->x).epsilon(0.15).margin(1e-2));
  }
  CHECK(seen > 300);
}
