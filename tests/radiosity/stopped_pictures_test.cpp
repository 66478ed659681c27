// SPDX-License-Identifier: MIT

// A picture, or its audit, that is told to stop at any moment ends at once. The work is counted in rays that meet an object of the test's
// own, so that the law does not depend on how fast or how busy the machine is.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <brep/builder_input.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

#include <radiosity/audit/picture_error.hpp>
#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

// Counts the lines that are intersected with it, and sets a flag at one of them.
class CountingBall final : public raycast::Object {
 public:
  CountingBall(const glm::dvec3& centre, double r) : ball_(raycast::Sphere::make(centre, r).object) {}
  [[nodiscard]] raycast::Box bounds() const override { return ball_->bounds(); }
  void spans(const raycast::Segment& line, raycast::Spans& out) const override {
    if (++asked_ == stop_at_) { stop_ = true; }
    ball_->spans(line, out);
  }
  void approximate(double tolerance, brep::Builder& out) const override { ball_->approximate(tolerance, out); }
  [[nodiscard]] raycast::SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return ball_->project(sheet, p); }

  // From now on counts anew, and sets the flag at line number `at`; 0: never.
  void stop_at(std::uint64_t at) const {
    asked_ = 0;
    stop_at_ = at;
    stop_ = false;
  }
  [[nodiscard]] std::uint64_t asked() const { return asked_; }
  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }

 private:
  std::shared_ptr<const raycast::Object> ball_;
  mutable std::atomic<std::uint64_t> asked_{0}, stop_at_{0};
  mutable std::atomic<bool> stop_{false};
};

// `work(control)` returns whether it was done to the end.
void check_ends_at_once(const CountingBall& ball, std::mt19937_64& random, const std::function<bool(const radiosity::Control&)>& work) {
  radiosity::Control control;
  control.cancel = &ball.stop();
  ball.stop_at(0);
  REQUIRE(work(control));
  const std::uint64_t whole = ball.asked();
  REQUIRE(whole > 20'000);
  for (int i = 0; i < 8; ++i) {
    const std::uint64_t at = 1 + random() % whole;
    ball.stop_at(at);
    const bool done = work(control);
    const std::uint64_t after = ball.asked() - at;
    CAPTURE(i, at, whole, after, done);
    // What a thread has begun is finished: one of 192 blocks of pixels in one of several stages, or a point. Those where the ball casts its
    // shadow ask it most: four times as often as the mean, on two threads, is 1 / 24.
    CHECK(after <= whole / 12);
    CHECK((!done || after == whole - at));
  }
}

}  // namespace

TEST_CASE("a picture in gathered light and its audit end at once when they are told to stop, at any moment") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  struct Kind {
    const char* name;
    radiosity::Scene scene;
    glm::dvec3 eye;
  };
  for (Kind& of :
       std::vector<Kind>{{"closed room", scenes::room_with_box(), {0.1, 0.1, 0.9}}, {"open", scenes::two_plates(0.5), {-1.0, -1.0, 0.5}}}) {
    INFO(of.name);
    const auto ball = std::make_shared<const CountingBall>(glm::dvec3{0.7, 0.6, 0.5}, 0.2);
    of.scene.objects.push_back(scenes::object("ball", ball));
    const radiosity::Solution solution = scenes::solved(of.scene, {.epsilon = 0.05, .min_area = 2e-3, .audit_points = 0});
    const radiosity::Camera camera{.eye = of.eye, .forward = glm::dvec3{0.6, 0.6, 0.5} - of.eye, .field_of_view = 70.0};
    const radiosity::View view = radiosity::make_view(camera, {256, 192});
    const radiosity::FinalGather light{of.scene, solution.mesh, solution.frame};
    std::optional<radiosity::Picture> picture;
    for (const unsigned threads : {1U, 2U}) {
      CAPTURE(threads);
      check_ends_at_once(*ball, random, [&](const radiosity::Control& control) {
        auto drawn = radiosity::draw(light, view, 1.0, threads, control);
        if (drawn) { picture = std::move(drawn); }
        return drawn.has_value();
      });
    }
    const auto audit = radiosity::PictureAudit::make(of.scene);
    REQUIRE(audit);
    check_ends_at_once(*ball, random, [&](const radiosity::Control& control) {
      return audit->measure(radiosity::audited(*picture, view, 1.0), {400, 1'000'000}, 1, 1, control).has_value();
    });
  }
}
