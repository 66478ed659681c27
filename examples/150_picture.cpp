// SPDX-License-Identifier: MIT
// A picture of a solved room, in letters. Light is gathered for each pixel: what the lamp sends exactly, what the walls send from the
// solution, so that a coarse solution is enough and shadows are sharp. picture.radiosity has the same pixels in W/m2.

#include <cstdio>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>

int main() {
  radiosity::Scene scene;
  scene.materials = {{"white", {0.7, 0.7, 0.7}, {0.0, 0.0, 0.0}}, {"lamp", {0.0, 0.0, 0.0}, {20.0, 20.0, 20.0}}};
  const auto lamp = raycast::Polygon::make({{1.5, 1, 2.5}, {1.5, 2, 2.5}, {2.5, 2, 2.5}, {2.5, 1, 2.5}});  // in the ceiling, faces down
  scene.objects = {{"room", raycast::BoxObject::make({0, 0, 0}, {4, 3, 2.5}).object, {}, {0}},
                   {"ball", raycast::Sphere::make({1.2, 1.7, 0.9}, 0.5).object, {}, {0}},
                   {"lamp", lamp.object, {}, {1}}};
  scene.objects[0].placement.inside = true;  // seen from within

  radiosity::Options options;
  options.epsilon = 0.08;
  options.audit_points = 0;
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  if (!outcome.solution) { return 1; }

  radiosity::Camera camera;
  camera.eye = {2.0, 0.05, 1.25};
  camera.forward = {0.0, 1.0, -0.05};
  camera.field_of_view = 75.0;
  radiosity::View view = radiosity::make_view(camera, {72, 60});
  const radiosity::FinalGather light{scene, outcome.solution->mesh, outcome.solution->frame};
  const radiosity::Tone tone{radiosity::automatic_exposure(outcome.solution->mesh, scene, view)};
  const auto picture = radiosity::draw(light, view, tone);
  if (!picture) { return 1; }
  for (std::uint32_t y = 0; y < picture->height; y += 2) {  // letters are twice as high as wide
    for (std::uint32_t x = 0; x < picture->width; ++x) { std::putchar(" .:-=+*#%@"[(picture->pixel(x, y)[0] * 10) / 256]); }
    std::putchar('\n');
  }
}
