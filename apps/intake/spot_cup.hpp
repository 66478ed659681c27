// SPDX-License-Identifier: MIT
#pragma once

// The cup of a spot: a lamp in the form of a ball lies deep in a black cup, whose rim hides more and more of it in directions farther
// from the axis. A file says how the intensity falls from the axis; the cup whose intensities are nearest to that is taken.

#include <memory>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include "apps/intake/model.hpp"

namespace apps {

// Lengths in radii of the ball.
struct SpotCup {
  double rim = 1.0;    // radius of the opening
  double depth = 1.0;  // of the ball's centre beneath the opening

  // RMS over the directions of the difference from the file's intensities, relative to their RMS.
  double difference = 0.0;
};

// The intensity of a spot at an angle from its axis (radians), relative to that on its axis, as its file says (ModelLight::Fade).
[[nodiscard]] double spot_intensity(const ModelLight& light, double angle);

// The share of the ball that is seen from far away at that angle. In directions perpendicular to the tilt the opening is as wide as it is,
// along the tilt its width shrinks by the cosine: an ellipse, which moves by the depth times the sine.
[[nodiscard]] double seen_through(const SpotCup& cup, double angle);

// Sends as much light as the spot of the file (to 1e-3), with the least RMS difference of intensities. Cones wider than a half-space are
// cut off there, narrower ones than a degree made as wide, and an edge takes a twentieth of the cone, or .02 radians, at least. No light
// falls farther beyond the cone than a tenth of it, or .02 radians; in the inner cone of glTF, from whose edge on the light falls steeply,
// the intensity is full up to .97 of it.
[[nodiscard]] SpotCup spot_cup(const ModelLight& light);

// The cup around a ball at a place, which shines in a direction of any length: a prism of 24 sides with a recess, the opening as large as
// the circle. Nothing if numbers leave no space for it.
[[nodiscard]] std::shared_ptr<const raycast::Object> recess(const SpotCup& cup, const glm::dvec3& ball, const glm::dvec3& direction,
                                                            double radius);

}  // namespace apps
