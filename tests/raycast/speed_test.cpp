// SPDX-License-Identifier: MIT
// How fast the compiled scene answers. Hidden: run `test_raycast "[.speed]"`. It prints and checks only that the answers are sane.

#include "support.hpp"

#include <chrono>
#include <iostream>

using namespace raycast;
using namespace test;

namespace {

// The Cornell box as 17 polygons, in millimetres; the left wall is not planar in the published data and is two triangles.
std::vector<Corners> cornell() {
  return {{{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}},
          {{343, 548.8, 227}, {343, 548.8, 332}, {213, 548.8, 332}, {213, 548.8, 227}},
          {{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}},
          {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}},
          {{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}},
          {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}},
          {{552.8, 0, 0}, {556, 548.8, 559.2}, {556, 548.8, 0}},
          {{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}},
          {{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}},
          {{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}},
          {{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}},
          {{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}},
          {{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}},
          {{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}},
          {{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}},
          {{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}},
          {{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}};
}

struct Query {
  Segment segment;
  std::uint32_t source, target;
};

void report(const char* name, const Scene& scene, const std::vector<Query>& queries) {
  using Clock = std::chrono::steady_clock;
  double occluded = infinity, closest = infinity;
  std::size_t blocked = 0, met = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = Clock::now();
    blocked = met = 0;
    for (const Query& q : queries) { blocked += scene.occluded(q.segment, q.source, q.target); }
    const auto middle = Clock::now();
    for (const Query& q : queries) { met += scene.closest(q.segment, q.source).has_value(); }
    occluded = std::min(occluded, std::chrono::duration<double>(middle - start).count());
    closest = std::min(closest, std::chrono::duration<double>(Clock::now() - middle).count());
  }
  const double count = static_cast<double>(queries.size());
  std::cout << name << ": occluded " << count / occluded * 1e-6 << " M/s (" << 100.0 * static_cast<double>(blocked) / count
            << " % blocked), closest " << count / closest * 1e-6 << " M/s (" << 100.0 * static_cast<double>(met) / count << " % met)\n";
  CHECK(blocked < queries.size());
}

}  // namespace

TEST_CASE("speed: occlusion segments through the Cornell box and through spheres", "[.speed]") {
  SEEDED(random);
  const std::vector<Corners> faces = cornell();
  std::vector<PlacedObject> objects;
  for (const Corners& face : faces) { objects.push_back(placed(Polygon::make(face))); }
  const auto on = [&](std::uint32_t i) {
    const Corners& p = faces[i];
    double a = random.uniform(), b = random.uniform();
    if (p.size() == 3 && a + b > 1) { a = 1 - a, b = 1 - b; }
    if (p.size() == 3) { return p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]); }
    return (1 - a) * ((1 - b) * p[0] + b * p[1]) + a * ((1 - b) * p[3] + b * p[2]);
  };
  std::vector<Query> queries;
  while (queries.size() < 200000) {
    const std::uint32_t i = random.below(static_cast<std::uint32_t>(faces.size())),
                        j = random.below(static_cast<std::uint32_t>(faces.size()));
    const dvec3 p = on(i), q = on(j);
    if (i != j && glm::dot(plane_of(faces[i]).normal, q - p) > 0 && glm::dot(plane_of(faces[j]).normal, p - q) > 0) {
      queries.push_back({between(p, q), i, j});
    }
  }
  report("Cornell box, 17 polygons, between facing surfaces", Scene(objects), queries);
  for (const int count : {8, 64, 10000}) {
    objects.clear();
    for (int i = 0; i < count; ++i) { objects.push_back(placed(Sphere::make(random.in_cube(), count > 100 ? 0.02 : 0.1))); }
    for (Query& q : queries) { q = {between(random.in_cube(), random.in_cube()), no_object, no_object}; }
    report((std::to_string(count) + " spheres, any two points").c_str(), Scene(objects), queries);
  }
}
