// SPDX-License-Identifier: MIT
#pragma once

// An object, or one sheet of it, as convex planar facets with the edges between them: what its outline from a point is made of.
//
// An edge belongs to the outline seen from x when one of its facets faces x and the other does not. So the form factor from x to all facets
// that face it is the contour integral over the outline alone (Lambert 1760): edges between two facets that face x cancel. Where the body
// reaches below the horizon of x, the outline goes along the horizon, from facet to facet. And what a
// convex body hides from x is the cone over its outline, however many facets it has.
//
// (Facets of a curved body need not be convex together, where corners of a quadrilateral are not in one plane; their corners are on it.)

#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

struct Facets {
  struct Facet {
    Polygon contour;  // convex, counter-clockwise seen from the air
    glm::dvec3 normal{0.0};
    double offset = 0.0;  // normal . x on its plane
    double area = 0.0;
    [[nodiscard]] double height(const glm::dvec3& x) const { return glm::dot(normal, x) - offset; }
  };
  static constexpr std::uint32_t none = 0xffffffff;
  struct Edge {
    glm::dvec3 a{0.0}, b{0.0};                // in the order of its left facet
    std::uint32_t left = none, right = none;  // right: none at a border
  };
  std::vector<Facet> facets;
  std::vector<Edge> edges;

  [[nodiscard]] bool empty() const { return facets.empty(); }
};

// The facets of one sheet of a boundary, or of all its faces that belong to a sheet.
[[nodiscard]] Facets facets_of(const Surface& surface, std::uint32_t sheet = Facets::none);
// The facets of these sheets, which are given in ascending order.
[[nodiscard]] Facets facets_of(const Surface& surface, std::span<const std::uint32_t> sheets);
// Adds `more` to `facets`.
void append(Facets& facets, const Facets& more);
// The facets of a curved object, within a tolerance (a length) of the true surface.
[[nodiscard]] Facets facets_of(const raycast::PlacedObject& object, double tolerance, std::uint32_t sheet = Facets::none);

// The part of the edge's contour integral, times 2 pi, from the point x with unit normal n; a to b.
[[nodiscard]] double contour_term(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& a, const glm::dvec3& b);

// F from x to all facets that face it, as if nothing stood in between. A facet faces x when x is higher above its plane than `slack`: a
// point on a sheet is on the plane of its other side, too, and rounding alone would let it see that side all around it. `facing` is memory
// that is used again.
[[nodiscard]] double form_factor(const Facets& facets, const glm::dvec3& x, const glm::dvec3& n, bool above_horizon, double slack,
                                 std::vector<char>& facing);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/facets.cpp>
#endif
