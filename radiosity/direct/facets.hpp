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

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
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
  // Of one body: its range of the facets and of the edges, and a sphere and a box around it.
  struct Part {
    std::uint32_t facets_begin = 0, facets_end = 0;
    std::uint32_t edges_begin = 0, edges_end = 0;
    glm::dvec3 centre{0.0};
    double radius = 0.0;
    glm::dvec3 half{0.0};    // of the sides of the box, which has the same centre
    double roundness = 0.0;  // (light_vector.hpp) if it is known
    // How far it reaches from its centre along a unit vector or its opposite, at most.
    [[nodiscard]] double extent(const glm::dvec3& along) const { return std::min(radius, glm::dot(glm::abs(along), half)); }
  };
  std::vector<Facet> facets;
  std::vector<Edge> edges;
  std::vector<Part> parts;  // what `append` has put together, in order

  [[nodiscard]] bool empty() const { return facets.empty(); }
};

// The facets of one sheet of a boundary, or of all its faces that belong to a sheet.
[[nodiscard]] Facets facets_of(const Surface& surface, std::uint32_t sheet = Facets::none);
// The facets of these sheets, which are given in ascending order.
[[nodiscard]] Facets facets_of(const Surface& surface, std::span<const std::uint32_t> sheets);
// Adds all of `more` to `facets`, as one part.
void append(Facets& facets, const Facets& more);
// The facets of a curved object, within a tolerance (a length) of the true surface.
[[nodiscard]] Facets facets_of(const raycast::PlacedObject& object, double tolerance, std::uint32_t sheet = Facets::none);

// F from x with unit normal n to those facets of the part that face x, as if nothing stood in between. A facet faces x when x is higher
// above its plane than `slack`: a point on a sheet is on the plane of its other side, too, and rounding alone would let it see that side
// all around it. `facing` is memory that is used again.
[[nodiscard]] double form_factor(const Facets& facets, const Facets::Part& part, const glm::dvec3& x, const glm::dvec3& n, double slack,
                                 std::vector<char>& facing);
// To all facets.
[[nodiscard]] double form_factor(const Facets& facets, const glm::dvec3& x, const glm::dvec3& n, double slack, std::vector<char>& facing);
// The vector whose product with the unit normal of the point x is the edge's part of the contour integral, times 2 pi; a to b.
[[nodiscard]] glm::dvec3 contour_vector(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b);

// Visits those of the edges that are on the outline seen by whom these facets face, each in the order of its facet: from a to b.
template <class Visit>
void for_outline(std::span<const Facets::Edge> edges, const std::vector<char>& facing, const Visit& visit) {
  for (const Facets::Edge& edge : edges) {
    const bool left = facing[edge.left] != 0;
    const bool right = edge.right != Facets::none && facing[edge.right] != 0;
    if (left == right) { continue; }
    if (left) {
      visit(edge.a, edge.b);
    } else {
      visit(edge.b, edge.a);
    }
  }
}

// The width of a cylinder around the facets whose axis runs through the centre, along their longest edge.
[[nodiscard]] double width_about_longest_edge(const Facets& facets, const glm::dvec3& centre);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/facets.cpp>
#endif
