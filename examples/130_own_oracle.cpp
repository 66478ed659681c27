// SPDX-License-Identifier: MIT

// An oracle of your own: one value with one function, given to the solver in its options. This one links two patches when they are far
// apart compared with their size, and looks at no form factor at all; where they are not, the larger one is split. What it is worth
// against the F-oracle of the library is told by the estimated error and the number of links.

#include <algorithm>
#include <cstdio>

#include <glm/geometric.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

struct FarApart {
  double ratio;  // of the distance of the centres to the sum of the radii, at least

  radiosity::Decision operator()(const radiosity::Question& question) const {
    const radiosity::Node &p = question.node_p(), &q = question.node_q();
    if (glm::length(q.centre - p.centre) >= ratio * (p.radius + q.radius)) { return radiosity::Decision::link; }
    if (std::max(p.area, q.area) <= question.min_area) { return radiosity::Decision::link; }
    return p.area >= q.area ? radiosity::Decision::split_p : radiosity::Decision::split_q;
  }
};
static_assert(radiosity::Oracle<FarApart>);

int main() {
  radiosity::Scene scene;
  scene.materials = {{"lamp", {0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}}, {"wall", {0.7, 0.7, 0.7}, {0.0, 0.0, 0.0}}};
  const auto room = raycast::BoxObject::make({0, 0, 0}, {4, 3, 2.5});
  const auto lamp = raycast::Polygon::make({{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}});  // faces down
  scene.objects = {{"room", room.object, {}, {1}}, {"lamp", lamp.object, {}, {0}}};
  scene.objects[0].placement.inside = true;

  radiosity::Options options;
  options.epsilon = 0.05;
  options.min_area = 2.5e-4;
  options.light_epsilon = 1e9;  // so that the light oracle never objects
  options.audit_points = 500;
  const auto report = [&](const char* name) {
    const radiosity::Outcome outcome = radiosity::solve(scene, options);
    if (!outcome.solution) { return 1; }
    const radiosity::Audit& audit = outcome.solution->audit;
    std::printf("%s: %llu leaves, %llu links, estimated error %.1f %%, mean of the floor %.2f W/m2\n", name,
                static_cast<unsigned long long>(audit.leaves), static_cast<unsigned long long>(audit.links),
                100.0 * audit.estimated_error.value_or(0.0), audit.surfaces[4].radiosity.x);
    return 0;
  };
  const int failed = report("form factors");
  options.oracle = FarApart{1.5};
  return failed + report("far apart");
}
