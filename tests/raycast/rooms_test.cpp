// SPDX-License-Identifier: MIT
// Rooms, which rays meet after all else: what stands in them, in their walls or beyond them is met in its order.

#include "primitives.hpp"

#include <algorithm>
#include <cstdint>

using namespace raycast;
using namespace test;

namespace {

Made<Object> any_body(std::uint32_t shape) {
  switch (shape) {
    case 0:
      return BoxObject::make({-1, -1, -1}, {1, 1, 1});
    case 1:
      return Sphere::make({0, 0, 0}, 1.3);
    case 2:
      return Cylinder::make({0, 0, -1}, {0, 0, 2}, 1.2);
    default:
      return Cone::make({0, 0, -1}, {0, 0, 3}, 1.5, 0.5);
  }
}

// A room about the origin, and boxes and spheres in it: some stand on a wall from within, some stick in one, some stand beyond.
std::vector<PlacedObject> furnished(Random& random, const Placement& turned, std::uint32_t shape) {
  const Placement room{turned.linear, turned.translation, true};
  std::vector<PlacedObject> objects{placed(any_body(shape), room)};
  for (int i = 0; i < 12; ++i) {
    const double size = random.uniform(0.05, 0.3);
    dvec3 at = 1.3 * random.in_cube();
    const std::uint32_t side = random.below(3);
    const auto axis = static_cast<int>(random.below(3));
    if (side < 2) { at[axis] = side == 0 ? -1.0 + size : 1.0 - size; }  // flush with the wall
    const Placement placement{turned.linear, turned.linear * at + turned.translation, false};
    if (random.below(3) == 0) {
      objects.push_back(placed(Sphere::make({0, 0, 0}, size), placement));
    } else {
      objects.push_back(placed(BoxObject::make(dvec3{-size}, dvec3{size}), placement));
    }
  }
  return objects;
}

}  // namespace

TEST_CASE("the first hit in a furnished room is the nearest begin of a span, the walls' included, alone and by sixteen") {
  SEEDED(random);
  for (std::uint32_t k = 0; k < 40; ++k) {
    const Placement turned{random.rotation(), random.in_cube(), false};
    const std::vector<PlacedObject> objects = furnished(random, turned, k % 4);
    const Scene scene(objects);
    int walls = 0, things = 0;
    for (int i = 0; i < 50; ++i) {
      Segments16 rays;
      double nearest[16];
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Segment s{turned.linear * random.in_cube() + turned.translation, 4.0 * random.direction()};
        double first = infinity;
        bool buried = false;
        for (const PlacedObject& object : objects) {
          for (const Span& span : spans(object, s)) {
            buried = buried || (span.in.t <= 0.0 && span.out.t >= 0.0);
            if (span.in.t > 0.0) { first = std::min(first, span.in.t); }
          }
        }
        if (buried) { continue; }
        nearest[lane] = first;
        rays.set(lane, s, no_object, no_object);
      }
      const Hits16 hits = scene.closest16(rays);
      for (unsigned lane = 0; lane < 16; ++lane) {
        if (!(rays.lanes >> lane & 1u)) { continue; }
        REQUIRE((hits.met >> lane & 1u));
        const auto alone = scene.closest(rays.at(lane));
        REQUIRE(alone);
        // Where two surfaces coincide, rounding of their places decides; a line meets both within 1e-9 unless it lies in them.
        CHECK(std::abs(hits.hit[lane].t - nearest[lane]) < 1e-9);
        CHECK(alone->t == hits.hit[lane].t);
        CHECK(alone->object == hits.hit[lane].object);
        (hits.hit[lane].object == 0 ? walls : things) += 1;
      }
    }
    CHECK(walls > 0);
    CHECK(things > 0);
  }
}
