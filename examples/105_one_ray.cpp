// SPDX-License-Identifier: MIT
// The ray caster alone: what does a ray meet first, and what stands between two points?

#include <cstdio>
#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

int main() {
  const auto ball = raycast::Sphere::make({0, 0, 1}, 1.0);
  const auto table = raycast::BoxObject::make({-2, -2, -0.5}, {2, 2, 0});
  const raycast::Scene scene({raycast::PlacedObject(ball.object), raycast::PlacedObject(table.object)});

  // A segment is its origin and the way to its end: t runs from 0 to 1.
  const raycast::Segment down{{0, 0, 4}, {0, 0, -4}};
  if (const auto hit = scene.closest(down)) {
    std::printf("meets object %u at t = %.3f, height %.3f\n", hit->object, hit->t, down.at(hit->t).z);
  }

  // Of a point on the table, past the ball: what an end lies on is named, so that its own skin does not block.
  const raycast::Segment beside{{1.5, 0, 0}, {0, 0, 3}}, through{{1.5, 0, 0}, {-3, 0, 2}};
  std::printf("up beside the ball: %s\n", scene.occluded(beside, 1) ? "occluded" : "clear");
  std::printf("through the ball: %s\n", scene.occluded(through, 1) ? "occluded" : "clear");
}
