// SPDX-License-Identifier: MIT
#include "apps/dark_picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/material.hpp>

namespace apps {

std::string warning_of_dark_picture(const radiosity::Picture& picture, const SceneFile& file, const radiosity::View& view) {
  double most = 0.0;
  for (const radiosity::Material& material : file.scene.materials) { most = std::max(most, radiosity::brightest(material.emission)); }
  const auto lit = [&](const glm::dvec3& radiosity) { return radiosity::brightest(radiosity) > 1e-9 * most; };
  if (std::any_of(picture.radiosity.begin(), picture.radiosity.end(), lit)) { return {}; }
  std::vector<raycast::PlacedObject> objects;
  for (const radiosity::SceneObject& object : file.scene.objects) { objects.emplace_back(object.shape, object.placement); }
  const raycast::Scene scene(std::move(objects));
  constexpr int across = 32, down = 24, rays = across * down;
  int fronts = 0, backs = 0;
  for (int i = 0; i < rays; ++i) {
    const double x = (i % across + 0.5) / across * view.size.width, y = (i / across + 0.5) / down * view.size.height;
    const auto hit = scene.closest({view.eye, view.direction(x, y)});
    if (hit) { ++(hit->front ? fronts : backs); }
  }
  const auto percent = [&](int count) { return std::to_string(std::lround(100.0 * count / rays)) + " %"; };
  std::string text = "the picture is black: no pixel of it sees any light. Of its area " + percent(backs) +
                     " first meets the backs of surfaces, " + percent(fronts) + " the fronts of dark ones, " +
                     percent(rays - fronts - backs) + " nothing; try another place (--camera)";
  if (backs > 0) { text += ", or give the surfaces two sides (--two-sided, or two-sided after a mesh of a scene)"; }
  return text;
}

}  // namespace apps
