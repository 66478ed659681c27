// SPDX-License-Identifier: MIT
#pragma once

// Indirect light between points at which it was gathered (irradiance cache; Ward, Rubinstein and Clear 1988). It changes within the
// distance of what a point sees, so each point is good for a sphere around it whose radius follows from these distances.
//
// The light of a point and how it changes are taken from all points in a sphere around it (weighted least squares), which also takes out
// most of the noise of the rays. Points with a smaller sphere lie closer, and each counts by the area of its own: a crowd in a bright gap
// does not draw the plane to itself. The sphere of the fit may be wider than the one for which the point is good: where points are close
// for other reasons than the light, they have much noise to share and little to tell apart. The widest sphere is taken in which a plane
// explains what was gathered up to the noise that it has.
//
// Beyond its points a plane soon says nonsense, less than no light at all beside a lamp. So what it says is held within bounds that the
// points give (neighbour clamping, Krivanek 2006): all channels by the same part, or the light would change its colour there.

#include <algorithm>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {

// What a point takes, by measurement: rays, the share of its light at which they are enough, and paths; the radius of its sphere by the
// harmonic mean distance of what it sees, and that of its fit by that of its sphere.
struct GatherRays {
  std::uint32_t least = 512, most = 2048;  // fewer would agree too often by chance
  double error = 0.03;
  std::uint32_t most_paths = 256;
};
inline constexpr GatherRays gather_rays;
// Of a point that is gathered once more because it was doubtful. What is near leaves most noise, so it takes most of the work.
inline constexpr GatherRays gather_rays_again{1024, 4096, 0.02, 1024};
inline constexpr double gathered_part_of_distance = 0.2, most_fit = 3.0;
// Of the distance of the nearest things: the mean does not tell of an eave that few rays meet, and a step farther many do.
inline constexpr double gathered_part_of_nearest = 0.75;
[[nodiscard]] inline double sphere_radius(double nearness, double nearest) {
  const double by_mean = nearness > 0.0 ? gathered_part_of_distance / nearness : raycast::infinity;
  return std::min(by_mean, gathered_part_of_nearest * nearest);
}

struct GatheredPoint {
  glm::dvec3 position{0.0}, normal{0.0};
  std::uint32_t object = 0;
  double radius = 0.0;  // of the sphere, in the unit of the position
  double widest = 0.0;  // of the sphere of the fit, at most; at least the radius
  Color gathered{0.0};
  double variance = 0.0;  // of the sum of its channels
  // What the fit makes of it: the light at the point, and its change by length along two tangents.
  Color light{0.0};
  glm::dvec3 s{0.0}, t{0.0};
  Color by_s{0.0}, by_t{0.0};
  Color mean{0.0};              // by weight, of the points of the sphere
  Color least{0.0}, most{0.0};  // of what the fit may say

  // The weight of this point at a place, when its sphere has this radius: 0 where it says nothing, 1 at the point itself.
  [[nodiscard]] double weight(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there, double sphere) const;
  [[nodiscard]] double weight(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there) const {
    return weight(place, normal_there, object_there, radius);
  }
  // Is a place so near that no further point is needed?
  [[nodiscard]] bool covers(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there) const;
  // What the fit says at a place of the sphere, within its bounds.
  [[nodiscard]] Color at(const glm::dvec3& place) const;
};

// Is what was gathered at `point` likely to be noise? It is where the points around it lie on a plane and it lies off that by more than
// their rest and its noise explain. `near` as for fit().
//
// Rays that all miss what is bright agree with each other and stop early, so that a point may be too dark and not know it: a stain in a
// picture. If it is gathered once more, by other rays, what was found first must not count: it was chosen for what it found.
[[nodiscard]] bool is_doubtful(const GatheredPoint& point, std::span<const GatheredPoint* const> near);

// Fits `point` to the points of its sphere; `near` are those that may be in the widest one, itself among them, in a fixed order. Of the
// others only what was gathered is read, so points can be fitted at the same time.
void fit(GatheredPoint& point, std::span<const GatheredPoint* const> near);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/gathered_point.cpp>
#endif
