// SPDX-License-Identifier: MIT
// Cameras and lights of the scene graph.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {

void add_camera(Model& model, const Node& node, const State& state, Notes& notes) {
  const glm::dvec4 orientation = node.rotation("orientation");
  const glm::dvec3 axis(orientation);
  const glm::dmat3 turn =
      glm::length(axis) > 0.0 ? glm::dmat3(glm::rotate(glm::dmat4(1.0), orientation.w, glm::normalize(axis))) : glm::dmat3(1.0);
  const glm::dmat3 linear(state.transform);
  radiosity::Camera camera;
  const bool v97 = node.version == Version::v97;
  camera.name = node.name.empty() ? node.word("description", "") : node.name;
  if (camera.name.empty()) { camera.name = "camera" + std::to_string(model.cameras.size()); }
  camera.eye = placed(state, node.vector("position", {0.0, 0.0, v97 ? 10.0 : 1.0}));
  camera.forward = linear * (turn * glm::dvec3(0.0, 0.0, -1.0));
  camera.up = linear * (turn * glm::dvec3(0.0, 1.0, 0.0));
  const bool parallel = node.type == "OrthographicCamera";
  const double half_height = parallel ? 0.5 * node.number("height", 2.0) / node.number("focalDistance", 5.0)
                                      : std::tan(0.5 * node.number(v97 ? "fieldOfView" : "heightAngle", 0.785398));
  camera.field_of_view = 2.0 * std::atan(4.0 / 3.0 * half_height) * 180.0 / std::numbers::pi;  // for pictures of 4 : 3
  if (!usable(camera)) { return notes.add("cameras that see nothing are passed over", at_line_of(node)); }
  if (parallel) { notes.add("cameras without perspective get one that shows as much at their focal distance", at_line_of(node)); }
  model.cameras.push_back(std::move(camera));
}

void add_light(Model& model, const Node& node, const State& state) {
  if (node.is_false("on")) { return; }
  const double intensity = node.number("intensity", 1.0);
  const glm::dvec3 color = node.vector("color", glm::dvec3(1.0));
  const bool v97 = node.version == Version::v97;
  ModelLight light;
  light.kind = node.type == "DirectionalLight" ? ModelLight::Kind::sun
               : node.type == "SpotLight"      ? ModelLight::Kind::spot
                                               : ModelLight::Kind::point;
  light.position = placed(state, node.vector("location", {0.0, 0.0, v97 ? 0.0 : 1.0}));
  light.intensity = glm::max(intensity * color, glm::dvec3(0.0));
  light.direction = glm::dmat3(state.transform) * node.vector("direction", {0.0, 0.0, -1.0});
  light.outer = node.number("cutOffAngle", 0.785398);
  if (v97) {
    light.inner = node.number("beamWidth", 1.570796);
    light.fade = ModelLight::Fade::by_angle;
  } else {
    light.fade = ModelLight::Fade::power_of_cosine;
    light.power = 128.0 * std::clamp(node.number("dropOffRate", 0.0), 0.0, 1.0);
  }
  const glm::dvec3 attenuation = node.vector("attenuation", {1.0, 0.0, 0.0});
  light.fades_otherwise = v97 && light.kind != ModelLight::Kind::sun && (attenuation.x != 0.0 || attenuation.y != 0.0);
  model.lights.push_back(light);
}

}  // namespace apps::vrml
