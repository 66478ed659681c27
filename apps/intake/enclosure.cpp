// SPDX-License-Identifier: MIT
#include "apps/intake/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/text.hpp"

namespace apps {
namespace {

constexpr double much_larger = 10.0, too_far = 1000.0, far = 100.0;  // relative to the size of all else
constexpr double of_speck = 1e5;                                     // "all else" is not the model then, but a speck in it

// The bounds of the polygons that have an area.
raycast::Box bounds_of(const radiosity::PolygonView& polygons) {
  raycast::Box box;
  std::vector<glm::dvec3> outline;
  for (std::size_t p = 0; p < polygons.count(); ++p) {
    outline.clear();
    for (std::uint32_t c = polygons.first_corner[p]; c < polygons.first_corner[p + 1]; ++c) {
      if (polygons.corners[c] < polygons.positions.size()) { outline.push_back(polygons.positions[polygons.corners[c]]); }
    }
    if (outline.size() < 3) { continue; }
    const double area = glm::length(brep::vector_area(outline));
    if (!(area > 0.0 && std::isfinite(area))) { continue; }
    for (const glm::dvec3& corner : outline) { box.extend(corner); }
  }
  return box;
}

bool within(const radiosity::SceneObject& shell, const std::vector<glm::dvec3>& points) {
  raycast::Placement solid = shell.placement;
  solid.inside = false;
  const raycast::PlacedObject placed(shell.shape, solid);
  return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
    raycast::Spans spans;
    placed.spans({p, {0, 0, 1}}, spans);
    return std::any_of(spans.begin(), spans.end(), [](const raycast::Span& span) { return span.in.t < 0.0 && span.out.t > 0.0; });
  });
}

}  // namespace

std::string take_enclosure(Model& model, const Panes& panes, const SceneFile& file) {
  raycast::Box rest = bounds_of(panes.others(model, {}));
  std::vector<raycast::Box> boxes;
  std::size_t largest = 0;
  for (const radiosity::SceneObject& object : model.objects) {
    boxes.push_back(radiosity::placed_bounds(*object.shape, object.placement));
    if (boxes.back().diameter() > boxes[largest].diameter()) { largest = boxes.size() - 1; }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i != largest && !panes.has(model.objects[i])) { rest.extend(boxes[i]); }
  }
  if (boxes.empty() || rest.size() == glm::dvec3(0.0) || !boxes[largest].contains(rest)) { return {}; }
  radiosity::SceneObject& shell = model.objects[largest];
  std::vector<glm::dvec3> points;
  for (unsigned i = 0; i < 8; ++i) { points.push_back(rest.corner(i)); }
  for (const radiosity::Camera& camera : file.cameras) { points.push_back(camera.eye); }
  for (const ModelLight& light : model.lights) {
    if (light.kind != ModelLight::Kind::sun) { points.push_back(light.position); }
  }
  const double times = boxes[largest].diameter() / rest.diameter();
  if (!(times < of_speck) || panes.has(shell) || !within(shell, points)) { return {}; }

  const bool from_within = shell.placement.inside;
  std::string sentence = "'" + shell.name + "' encloses all else";
  if (times > much_larger) { sentence += ", which is " + formatted("%.2g", times) + " times smaller"; }
  if (times > (from_within ? too_far : much_larger) && !radiosity::shines(file.scene, shell)) {
    model.objects.erase(model.objects.begin() + static_cast<std::ptrdiff_t>(largest));
    model.origins.erase(model.origins.begin() + static_cast<std::ptrdiff_t>(largest));
    return sentence + ": left out, for it is too far away to send light back";
  }
  shell.placement.inside = true;
  if (times > too_far) {
    const double scale = far / times;
    shell.placement = raycast::compose({glm::dmat3(scale), (1.0 - scale) * rest.centre(), false}, shell.placement);
    return sentence + (from_within ? ": brought near" : ": brought near, and seen from within");
  }
  return from_within ? std::string() : sentence + ": seen from within";
}

}  // namespace apps
