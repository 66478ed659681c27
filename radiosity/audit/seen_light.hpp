// SPDX-License-Identifier: MIT
#pragma once

// Estimates the light that surfaces reflect at single points, before anything is solved: so that a camera can be chosen that sees some.
// A few short paths for each point tell its brightness to some tens of percent; what reflects a hundredth of what is usual is told from
// what is well lit, no more.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

class SeenLight {
 public:
  // Nothing for an invalid scene, or for one in which nothing emits.
  [[nodiscard]] static std::optional<SeenLight> make(const Scene& scene);

  // The light that a surface reflects, in its brightest channel, at a point of it, in scene coordinates, without what was reflected more
  // than `most` times; in a unit common to the scene. `key` chooses the random numbers.
  [[nodiscard]] double reflected(const raycast::ScenePoint& at, std::uint32_t most, std::uint64_t key) const;

  // Nine tenths of the reflected light come from surfaces that are at least so bright, in the unit of reflected(). So what leaks out of a
  // house, however large the ground around it, does not tell what is usual, nor does the inside of a lampshade, unless hardly any light
  // comes out of it. 0 if no light is found, as of a sun whose rays nearly all miss the scene.
  [[nodiscard]] double usual() const { return usual_; }

  // For each of at most `most` surfaces that emit more than `least`, brightest channel in W/m2, evenly chosen among these: a point on its
  // largest face, in scene coordinates.
  [[nodiscard]] std::vector<raycast::ScenePoint> lamp_points(const Scene& scene, double least, std::size_t most) const;

 private:
  SeenLight(const Scene& scene, Prepared prepared);

  [[nodiscard]] double reflected_in_frame(const raycast::ScenePoint& at, std::uint32_t most, std::uint64_t key) const;
  [[nodiscard]] std::optional<raycast::ScenePoint> meet_front(const raycast::ScenePoint& from, const glm::dvec3& direction) const;
  [[nodiscard]] double find_usual(const std::vector<LampPhoton>& photons) const;

  std::unique_ptr<Prepared> prepared_;  // the tracer points into it
  PathTracer tracer_;
  std::uint32_t paths_ = 0;  // half as many as for each point
  double usual_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/seen_light.cpp>
#endif
