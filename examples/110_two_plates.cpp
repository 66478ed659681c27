// SPDX-License-Identifier: MIT

// Two facing plates, one of them a lamp: the smallest radiosity problem, and how to embed the solver.

#include <cstdio>

#include <raycast/objects/polygon.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/scene.hpp>

int main() {
  radiosity::Scene scene;
  scene.materials = {{"lamp", {0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}}, {"wall", {0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}}};
  const auto lower = raycast::Polygon::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});  // faces up
  const auto upper = raycast::Polygon::make({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});  // faces down
  scene.objects = {{"lower", lower.object, {}, {0}}, {"upper", upper.object, {}, {1}}};

  const radiosity::Outcome outcome = radiosity::solve(scene);
  if (!outcome.solution) { return 1; }
  const radiosity::Audit& audit = outcome.solution->audit;
  for (const radiosity::SurfaceMean& surface : audit.surfaces) {
    std::printf("%s: mean radiosity %.3f W/m2\n", surface.name.c_str(), surface.radiosity.x);
  }
  std::printf("rays cast: %llu, solver iterations: %u\n", static_cast<unsigned long long>(audit.rays), audit.iterations);
}
