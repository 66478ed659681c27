// SPDX-License-Identifier: MIT
#pragma once

// Small scenes with known solutions, for `halflight stress` and the tests.

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <raycast/objects/box.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/scene/scene.hpp>

namespace apps::stress {

inline radiosity::SceneObject object(std::string name, std::shared_ptr<const raycast::Object> shape, std::uint32_t material = 0,
                                     bool inside = false) {
  radiosity::SceneObject result;
  result.name = std::move(name);
  result.shape = std::move(shape);
  result.material = {material};
  result.placement.inside = inside;
  return result;
}

inline std::shared_ptr<const raycast::Object> box(const glm::dvec3& lo, const glm::dvec3& hi) {
  return raycast::BoxObject::make(lo, hi).object;
}

inline std::shared_ptr<const raycast::Object> polygon(std::vector<glm::dvec3> corners) {
  return raycast::Polygon::make(std::move(corners)).object;
}

// A polygon as an object.
inline radiosity::SceneObject plate(std::string name, std::vector<glm::dvec3> corners, std::uint32_t material = 0) {
  return object(std::move(name), polygon(std::move(corners)), material);
}

// A square of side 2 r about (x, y, z), facing up or down.
inline radiosity::SceneObject square(std::string name, const glm::dvec3& c, double r, bool up, std::uint32_t material = 0) {
  std::vector<glm::dvec3> corners{{c.x - r, c.y - r, c.z}, {c.x + r, c.y - r, c.z}, {c.x + r, c.y + r, c.z}, {c.x - r, c.y + r, c.z}};
  if (!up) { std::reverse(corners.begin(), corners.end()); }
  return plate(std::move(name), std::move(corners), material);
}

// Any closed scene with E = 1 - rho on every surface has B = 1 everywhere.
inline radiosity::Material furnace_material(double rho) { return {"furnace", radiosity::Color{rho}, radiosity::Color{1.0 - rho}}; }

inline radiosity::Scene furnace_cube(double rho) { return {{furnace_material(rho)}, {object("room", box({0, 0, 0}, {1, 1, 1}), 0, true)}}; }

inline radiosity::Scene furnace_sphere(double rho) {
  return {{furnace_material(rho)}, {object("sphere", raycast::Sphere::make({0, 0, 0}, 1.0).object, 0, true)}};
}

// A furnace with objects in it: a box on the floor, a sphere in the air, a cylinder on the floor.
inline radiosity::Scene furnace_with_things(double rho) {
  radiosity::Scene scene = furnace_cube(rho);
  scene.objects.push_back(object("box", box({0.1, 0.2, 0.0}, {0.4, 0.5, 0.3})));
  scene.objects.push_back(object("sphere", raycast::Sphere::make({0.7, 0.6, 0.6}, 0.15).object));
  scene.objects.push_back(object("cylinder", raycast::Cylinder::make({0.7, 0.25, 0.0}, {0, 0, 0.4}, 0.1).object));
  return scene;
}

// A grey closed room with a lamp flush with its ceiling and a box standing on the floor.
inline radiosity::Scene room_with_box() {
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{5.0}}};
  scene.objects = {object("room", box({0, 0, 0}, {1, 1, 1}), 0, true), object("box", box({0.3, 0.2, 0.0}, {0.6, 0.5, 0.5})),
                   object("lamp", polygon({{0.35, 0.35, 1.0}, {0.35, 0.65, 1.0}, {0.65, 0.65, 1.0}, {0.65, 0.35, 1.0}}), 1)};
  return scene;
}

// Two parallel unit squares at distance 1; the lower one emits.
inline radiosity::Scene two_plates(double rho) {
  radiosity::Scene scene;
  scene.materials = {{"lamp", radiosity::Color{rho}, radiosity::Color{1.0}}, {"wall", radiosity::Color{rho}, radiosity::Color{0.0}}};
  scene.objects = {object("lower", polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 0),
                   object("upper", polygon({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}), 1)};
  return scene;
}

// The scene scaled by `scale` and then moved by `offset`, by changing the placements.
inline radiosity::Scene moved(radiosity::Scene scene, double scale, const glm::dvec3& offset) {
  for (radiosity::SceneObject& o : scene.objects) {
    o.placement.linear = o.placement.linear * scale;
    o.placement.translation = o.placement.translation * scale + offset;
  }
  return scene;
}

}  // namespace apps::stress
