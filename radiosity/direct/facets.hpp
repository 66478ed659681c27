// SPDX-License-Identifier: MIT
#pragma once

// An object, or one sheet of it, as convex planar facets with the edges between them, from which its outline seen from a point is found.
//
// An edge belongs to the outline seen from x when exactly one of its facets faces x. So the form factor from x to all facets that face it
// is the contour integral over the outline alone (Lambert 1760), because edges between two facets that face x cancel. Where the body
// reaches below the horizon of x, the outline follows the horizon from facet to facet. A convex body hides from x the cone over its
// outline, however many facets it has.
//
// (The facets of a convex curved body need not form a convex polyhedron, where the corners of a quadrilateral do not lie in one plane.
// The corners lie on the body.)

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>

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
  struct Edge {
    glm::dvec3 a{0.0}, b{0.0};                                              // in the direction in which the left facet's contour runs
    std::uint32_t left = brep::invalid_index, right = brep::invalid_index;  // right: invalid at a border
  };
  // One body: its range of facets and edges, and a bounding sphere and box.
  struct Part {
    std::uint32_t facets_begin = 0, facets_end = 0;
    std::uint32_t edges_begin = 0, edges_end = 0;
    glm::dvec3 centre{0.0};
    double radius = 0.0;
    glm::dvec3 half{0.0};    // half side lengths of the box, which has the same centre
    double roundness = 0.0;  // see light_vector.hpp; 0: unknown or none
    // Upper bound of its extent from the centre along a unit vector or its opposite.
    [[nodiscard]] double extent(const glm::dvec3& along) const { return std::min(radius, glm::dot(glm::abs(along), half)); }
  };
  std::vector<Facet> facets;
  std::vector<Edge> edges;
  std::vector<Part> parts;  // one per call of `append`, in order

  [[nodiscard]] bool empty() const { return facets.empty(); }
};

// The facets of one sheet of a boundary, or (default) of all its faces that belong to a sheet.
[[nodiscard]] Facets facets_of(const Surface& surface, std::optional<std::uint32_t> sheet = {});
// The facets of these sheets, in ascending order.
[[nodiscard]] Facets facets_of(const Surface& surface, std::span<const std::uint32_t> sheets);
[[nodiscard]] double area_of(const Facets& facets);
// Is the point more than `slack` in front of more than half of the area?
[[nodiscard]] bool surrounds(const Facets& facets, const glm::dvec3& point, double slack);
// Does no corner of a closed body lie more than `tolerance` (a length) in front of one of its facets? False for bodies of more than
// 1000 facets, which are not checked.
[[nodiscard]] bool convex_within(const Facets& facets, double tolerance);
// Adds all of `more` to `facets`, as one part.
void append(Facets& facets, const Facets& more);
// The facets of a curved object, within a tolerance (a length) of the true surface.
[[nodiscard]] Facets facets_of(const raycast::PlacedObject& object, double tolerance, std::optional<std::uint32_t> sheet = {});

// Unoccluded form factor from x with unit normal n to those facets of the part that face x. A facet faces x when x lies more than `slack`
// above its plane. This excludes points on a two-sided sheet, which lie on the plane of its other side, where rounding alone could make
// them see that side all around. `facing`: scratch memory.
[[nodiscard]] double form_factor(const Facets& facets, const Facets::Part& part, const glm::dvec3& x, const glm::dvec3& n, double slack,
                                 std::vector<char>& facing);
// As above, to all facets.
[[nodiscard]] double form_factor(const Facets& facets, const glm::dvec3& x, const glm::dvec3& n, double slack, std::vector<char>& facing);
// The contribution of the edge from a to b to the contour integral, times 2 pi, is the dot product of this vector with the unit normal of
// x.
[[nodiscard]] glm::dvec3 contour_vector(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b);

// Calls visit(a, b) for the edges that lie on the outline seen by a point for which `facing` tells which facets face it; a to b is the
// direction of the facing facet's contour.
template <class Visit>
void for_outline(std::span<const Facets::Edge> edges, const std::vector<char>& facing, const Visit& visit) {
  for (const Facets::Edge& edge : edges) {
    const bool left = facing[edge.left] != 0;
    const bool right = edge.right != brep::invalid_index && facing[edge.right] != 0;
    if (left == right) { continue; }
    if (left) {
      visit(edge.a, edge.b);
    } else {
      visit(edge.b, edge.a);
    }
  }
}

// The diameter of a cylinder around the facets whose axis runs through the centre, parallel to their longest edge.
[[nodiscard]] double width_about_longest_edge(const Facets& facets, const glm::dvec3& centre);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/facets.cpp>
#endif
