// SPDX-License-Identifier: MIT
#pragma once

// The frame in which a run computes: the scene's centre is (nearly) the origin, and its size is in [1, 2). The scale is an
// exact power of two, so a scene scaled by a power of two gives the same bits, and a scene far from the origin loses no more
// precision than its input had lost already.

#include <optional>

#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/scene/scene.hpp>

namespace raycast {
class Scene;  // raycast/scene.hpp
}

namespace radiosity {

struct Frame {
  glm::dvec3 centre{0.0};
  double scale = 1.0;  // frame coordinate = (scene coordinate - centre) * scale

  [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& p) const { return p / scale + centre; }
  [[nodiscard]] double to_scene_area(double area) const { return area / scale / scale; }
};

// The frame of a valid scene; nothing if its bounds are not finite or have no size.
[[nodiscard]] std::optional<Frame> make_frame(const Scene& scene);

// The objects of the scene, compiled for rays in the coordinates of the frame.
[[nodiscard]] raycast::Scene compile(const Scene& scene, const Frame& frame);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/scene/frame.cpp>
#endif
