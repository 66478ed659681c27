// SPDX-License-Identifier: MIT
#pragma once

// Where the direct light on a flat face is not smooth (Heckbert 1992, Lischinski, Tampieri and Greenberg 1992). As a point moves over the
// face, what it sees of a polygonal lamp past polygonal blockers changes its kind at lines, in which critical surfaces meet the face:
//
//   contact    a blocker touches the face or goes through it: the light itself jumps                                    degree 0
//   EV, VE     a plane through an edge of the lamp and a vertex of a blocker, or a vertex of the lamp and an edge
//              of a blocker, that edge on the outline which the lamp sees: the light's second derivative jumps           degree 2,
//              and where an edge of both lies in the plane its first: half-shadows of parallel edges                     degree 1
//
// (EEE surfaces, of three edges that are skew, are curved and of degree 2; they are left out.) A line of the list reaches as far as lamp
// and blocker alone allow: where a third object covers the lamp or the blocker the light may be smooth across it.

#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

struct CriticalLine {
  glm::dvec3 from{0.0}, to{0.0};  // on the face
  int degree = 2;                 // the first derivative of the light that jumps
};

// A flat convex face that receives light.
struct ReceivingFace {
  Polygon contour;
  glm::dvec3 normal{0.0};  // unit length, towards the light

  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(normal, p - contour[0]); }
};

// Adds the lines of a flat lamp past one blocker, whose facets are exact. What is nearer than `tolerance`, a length, touches. Lines shorter
// than that are left out.
void add_critical_lines(const ReceivingFace& face, const Facets& lamp, const Facets& blocker, double tolerance,
                        std::vector<CriticalLine>& lines);

// The lines along which a blocker touches the face.
void add_contact_lines(const ReceivingFace& face, const Facets& blocker, double tolerance, std::vector<CriticalLine>& lines);

// Joins what lies on one line, within `tolerance`, and meets or overlaps; the joined line has the lowest degree of its parts. Lines of
// lower degree come first, and of one degree the longer ones.
void join_lines(std::vector<CriticalLine>& lines, double tolerance);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/critical_lines.cpp>
#endif
