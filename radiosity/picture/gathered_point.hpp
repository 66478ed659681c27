// SPDX-License-Identifier: MIT
#pragma once

// Indirect light interpolated between points at which it was gathered (irradiance cache; Ward, Rubinstein and Clear 1988). The light
// changes over the distance of what a point sees, so each point is valid in a sphere whose radius follows from these distances.
//
// The light of a point and its gradient are fitted to all points in a sphere around it (weighted least squares), which also removes most
// of the noise of the rays. Points with smaller spheres are denser, so each is weighted by the area of its sphere; otherwise a cluster of
// points in a bright gap would dominate the fit. The sphere of the fit may be larger than the sphere of validity: where points are dense
// for other reasons than the light, many are needed to average the noise and their light hardly differs. The largest sphere is used in
// which a plane explains the values up to their noise.
//
// Outside the range of its points a plane extrapolates badly, even to negative light beside a lamp. So its values are limited to a range
// given by the points (neighbour clamping, Krivanek 2006), with the same factor for all channels, which keeps the colour.

#include <algorithm>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {

// Effort for a point, found by measurement: numbers of rays, the relative error at which they suffice, and paths; below, the radius of
// its sphere relative to the harmonic mean distance of the hits, and the largest radius of the fit relative to that of the sphere.
struct GatherRays {
  std::uint32_t least = 512, most = 2048;  // fewer rays would agree too often by chance
  double error = 0.03;
  std::uint32_t most_paths = 256;
};
inline constexpr GatherRays gather_rays;
// For a point that stands for a single pixel between others: a quarter of the work, as the fit draws on the points around it.
inline constexpr GatherRays gather_rays_between{128, 512, 0.06, 64};
// For a point at a contact (radiosity/camera/contacts.hpp), which stands for a few pixels: as exact as others where its rays disagree, and
// with fewer rays where they agree, because many points share its fit, of which not all agree by chance.
inline constexpr GatherRays gather_rays_at_contact{128};
// For a point that is gathered again because it was doubtful. Nearby light causes most of the noise, so it gets most of the work.
inline constexpr GatherRays gather_rays_again{1024, 4096, 0.02, 1024};
inline constexpr double gathered_part_of_distance = 0.2, most_fit = 3.0;
// Relative to the distance of the nearest hits. The mean distance alone does not reflect an eave met by few rays, though many
// would meet it from a little farther away.
inline constexpr double gathered_part_of_nearest = 0.75;
[[nodiscard]] inline double sphere_radius(double nearness, double nearest) {
  const double by_mean = nearness > 0.0 ? gathered_part_of_distance / nearness : raycast::infinity;
  return std::min(by_mean, gathered_part_of_nearest * nearest);
}

struct GatheredPoint {
  glm::dvec3 position{0.0}, normal{0.0};
  std::uint32_t object = 0;
  double radius = 0.0;  // of the sphere of validity, in the unit of the position
  double widest = 0.0;  // upper limit of the radius of the fit; at least `radius`
  Color gathered{0.0};
  double variance = 0.0;  // of the sum of the channels
  // Result of the fit: the light at the point, and its derivatives along two tangents.
  Color light{0.0};
  glm::dvec3 s{0.0}, t{0.0};
  Color by_s{0.0}, by_t{0.0};
  Color mean{0.0};              // weighted mean of the points in the sphere
  Color least{0.0}, most{0.0};  // limits of the fitted light

  // The weight of this point at a place if its sphere has the radius `sphere`: 0 outside its validity, 1 at the point itself.
  [[nodiscard]] double weight(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there, double sphere) const;
  [[nodiscard]] double weight(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there) const {
    return weight(place, normal_there, object_there, radius);
  }
  // Is the place so near that no further point is needed?
  [[nodiscard]] bool covers(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there) const;
  // The fitted light at a place in the sphere, within its limits.
  [[nodiscard]] Color at(const glm::dvec3& place) const;
};

// Is the value gathered at `point` likely to be noise? It is if the surrounding points fit a plane, and it deviates from that by more
// than their residuals and its own noise explain. `near`: as for fit().
//
// Rays that all miss a bright object agree with each other and stop early, so a point may be too dark without noticing: a stain in the
// picture. If such a point is gathered again with other rays, the first value must be discarded, because it was the reason for the choice.
[[nodiscard]] bool is_doubtful(const GatheredPoint& point, std::span<const GatheredPoint* const> near);

// Fits `point` to the points in its sphere. `near`: the points that may be in the widest sphere, including itself, in a fixed order. Only
// their gathered values are read, so different points can be fitted in parallel.
void fit(GatheredPoint& point, std::span<const GatheredPoint* const> near);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/gathered_point.cpp>
#endif
