// SPDX-License-Identifier: MIT
#pragma once

// Lines on a flat face along which the direct light is not smooth (Heckbert 1992, Lischinski, Tampieri and Greenberg 1992). As a point
// moves over the face, its view of a polygonal lamp past polygonal blockers changes qualitatively at lines where critical surfaces meet
// the face:
//
//   contact    a blocker touches the face or passes through it: the light itself is discontinuous                       degree 0
//   EV, VE     a plane through an edge of the lamp and a vertex of a blocker, or through a vertex of the lamp and an
//              edge of a blocker that lies on the outline seen from the lamp: the second derivative is discontinuous    degree 2,
//              and the first one where the plane contains an edge of both (penumbrae of parallel edges)                 degree 1
//
// (EEE surfaces, through three skew edges, are curved and of degree 2; they are left out.) A line extends as far as lamp and blocker
// alone allow: where a third object hides one of them, the light may be smooth across it.

#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

struct CriticalLine {
  glm::dvec3 from{0.0}, to{0.0};  // on the face
  int degree = 2;                 // order of the lowest derivative of the light that is discontinuous
};

// A flat convex face that receives light.
struct ReceivingFace {
  Polygon contour;
  glm::dvec3 normal{0.0};  // unit length, towards the light

  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(normal, p - contour[0]); }
};

// Adds the lines caused by a flat lamp and one blocker, whose facets must be exact. Distances below `tolerance` (a length) count as
// contact, and lines shorter than that are left out.
void add_critical_lines(const ReceivingFace& face, const Facets& lamp, const Facets& blocker, double tolerance,
                        std::vector<CriticalLine>& lines);

// The lines along which a blocker touches the face.
void add_contact_lines(const ReceivingFace& face, const Facets& blocker, double tolerance, std::vector<CriticalLine>& lines);

// Joins collinear lines (within `tolerance`) that meet or overlap; the joined line has the lowest degree of its parts. Sorts the lines by
// ascending degree, and within one degree by descending length.
void join_lines(std::vector<CriticalLine>& lines, double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/critical_lines.cpp>
#endif
