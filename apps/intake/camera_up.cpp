// SPDX-License-Identifier: MIT
#include "apps/intake/camera_up.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace apps {

std::optional<UpAxis> up_of_cameras(std::span<const radiosity::Camera> cameras, UpAxis up) {
  if (up == UpAxis::x) { return std::nullopt; }
  const UpAxis other = up == UpAxis::y ? UpAxis::z : UpAxis::y;
  const auto axis = static_cast<int>(up), other_axis = static_cast<int>(other);
  constexpr double clear = 0.1;                                 // these three are sines
  constexpr double level_alone = 0.012, level_together = 0.05;  // the camera of Blender's first scene is off by 0.011
  double worst = 0.0;
  std::vector<glm::dvec3> against;  // directions of cameras that contradict `up`
  for (const radiosity::Camera& camera : cameras) {
    const glm::dvec3 forward = glm::normalize(camera.forward), right = glm::normalize(glm::cross(forward, camera.up)),
                     above = glm::cross(right, forward);
    worst = std::max({worst, std::abs(right[other_axis]), -above[other_axis]});
    const double turned = std::min(std::abs(right.x), std::abs(right[axis])),
                 pitched = std::min(std::abs(forward[other_axis]), above[other_axis]);
    if (std::min(turned, pitched) > clear) { against.push_back(forward); }
  }
  const bool together = std::any_of(against.begin(), against.end(), [&](const auto& f) { return glm::length(f - against[0]) > clear; });
  return !against.empty() && worst < (together ? level_together : level_alone) ? std::optional(other) : std::nullopt;
}

}  // namespace apps
