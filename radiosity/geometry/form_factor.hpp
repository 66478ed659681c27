// SPDX-License-Identifier: MIT
#pragma once

// Form factors without occlusion.
//
//   disk_estimate     point to disk of equal area, the paper's formula (section 4.3): cheap, never above 1,
//                     right far away. The oracle asks it.
//   point_to_polygon  Lambert's contour (Lambert 1760): exact for any planar polygon above the horizon.
//   clip_to_horizon   the part of a polygon above a plane; light never comes from below it.
//
// The exchange between two patches stands in exchange.hpp. Polygons are counter-clockwise seen from their
// bright side, of any number of corners.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity {

using Polygon = std::vector<glm::dvec3>;

// F from a point (normal n) to a patch of area `area` with centre c and normal m, both normals of length 1.
// Paper 4.3: F = cos_i cos_j A / (pi r^2 + A). 0 when either faces away.
[[nodiscard]] double disk_estimate(const glm::dvec3& point, const glm::dvec3& n, const glm::dvec3& c, const glm::dvec3& m, double area);

// Appends to `out` the part of `polygon` on or above the plane through p with normal n.
// Sutherland-Hodgman (1974): a convex polygon stays convex; corners exactly on the plane are kept.
void clip_to_horizon(std::span<const glm::dvec3> polygon, const glm::dvec3& p, const glm::dvec3& n, Polygon& out);

// F from the point x with unit normal n to the polygon, which must lie above the horizon of x and turn its
// bright side to x. Error: a few ulp of 1, also when x lies on the polygon's edge or plane. atan2 alone keeps
// this accuracy for edges that subtend more than a right angle.
[[nodiscard]] double point_to_polygon(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon);

// The same for all normals at once: the vector v with F = n . v, for each unit normal n whose horizon the polygon lies above.
[[nodiscard]] glm::dvec3 light_vector(const glm::dvec3& x, std::span<const glm::dvec3> polygon);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/form_factor.cpp>
#endif
