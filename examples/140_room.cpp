// SPDX-License-Identifier: MIT
// A solved room, and how one knows that it is right. A closed room of reflectance rho whose walls all emit E is a furnace: the radiosity is
// E / (1 - rho) everywhere, whatever the shape. With a lamp nothing is known beforehand, so the run tells its own error.

#include <algorithm>
#include <cstdio>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

static radiosity::SceneObject room(std::uint32_t material) {
  radiosity::SceneObject walls{"room", raycast::BoxObject::make({0, 0, 0}, {4, 3, 2.5}).object, {}, {material}};
  walls.placement.inside = true;  // seen from within
  return walls;
}

static radiosity::SceneObject ball(std::uint32_t material) {
  return {"ball", raycast::Sphere::make({1.2, 1, 0.8}, 0.5).object, {}, {material}};
}

int main() {
  radiosity::Scene furnace;
  furnace.materials = {{"glowing", {0.75, 0.75, 0.75}, {1.0, 1.0, 1.0}}};
  furnace.objects = {room(0), ball(0)};
  radiosity::Options options;
  options.epsilon = 0.08;    // the largest form factor that one link may carry (paper 4.4)
  options.audit_points = 0;  // nothing is to be measured where the truth is known
  const radiosity::Outcome same = radiosity::solve(furnace, options);
  if (!same.solution) { return 1; }
  double least = 1e9, most = 0.0;
  for (const radiosity::SurfaceMean& surface : same.solution->audit.surfaces) {
    least = std::min(least, surface.radiosity.x), most = std::max(most, surface.radiosity.x);
  }
  std::printf("furnace: radiosity from %.3f to %.3f, by the formula %.3f\n\n", least, most, 1.0 / (1.0 - 0.75));

  radiosity::Scene lit;
  lit.materials = {{"white", {0.7, 0.7, 0.7}, {0.0, 0.0, 0.0}}, {"lamp", {0.0, 0.0, 0.0}, {20.0, 20.0, 20.0}}};
  const auto lamp = raycast::Polygon::make({{1.5, 1, 2.5}, {1.5, 2, 2.5}, {2.5, 2, 2.5}, {2.5, 1, 2.5}});  // in the ceiling, faces down
  lit.objects = {room(0), ball(0), {"lamp", lamp.object, {}, {1}}};
  options.audit_points = 1000;
  std::puts("epsilon    leaves    links   floor     ball       row sums      error of all surfaces");
  for (const double epsilon : {0.08, 0.04, 0.02}) {
    options.epsilon = epsilon;
    options.min_area = 2.4 * epsilon * epsilon;  // so that shadows get finer, too
    const radiosity::Outcome outcome = radiosity::solve(lit, options);
    if (!outcome.solution) { return 1; }
    const radiosity::Audit& audit = outcome.solution->audit;
    std::printf("%7.2f %9llu %8llu  %6.3f   %6.3f   %.4f %.4f   about %.0f %%, at most %.0f %%\n", epsilon,
                static_cast<unsigned long long>(audit.leaves), static_cast<unsigned long long>(audit.links), audit.surfaces[4].radiosity.x,
                audit.surfaces[6].radiosity.x, audit.row_sum.min, audit.row_sum.max, 100.0 * audit.surface_error->relative_l2,
                100.0 * audit.surface_error->high);
  }
}
