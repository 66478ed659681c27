// SPDX-License-Identifier: MIT
#pragma once

// Form factors without occlusion.
//
//   disk_estimate     point to a disk of equal area, the paper's formula (section 4.3): cheap, never above 1, accurate far away.
//                     Used by the oracle.
//   point_to_polygon  Lambert's contour integral (Lambert 1760): exact for any planar polygon above the horizon.
//   clip_to_horizon   the part of a polygon above a plane; no light comes from below the horizon.
//
// The exchange between two patches is in exchange.hpp. Polygons may have any number of corners, counter-clockwise seen from their front.

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

// F from the point x with unit normal n to the polygon, which must lie above the horizon of x and face x. Error: a few ulp of
// 1, also when x lies on the polygon's edge or plane. atan2 is used because acos or asin would lose this accuracy for edges
// that subtend more than a right angle.
[[nodiscard]] double point_to_polygon(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon);

// As above for all normals at once: the vector v with F = n . v, for every unit normal n above whose horizon the polygon lies.
[[nodiscard]] glm::dvec3 light_vector(const glm::dvec3& x, std::span<const glm::dvec3> polygon);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/form_factor.cpp>
#endif
