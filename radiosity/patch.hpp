// SPDX-License-Identifier: MIT
#pragma once

// The geometry of one patch as the form factor and the visibility test want it: contour, plane, size, and the
// points of quadrature rules. One is made of every node of the hierarchy and lives until the end of the run (Patches, occlusion.hpp),
// because the node takes part in many links: about 1.4 kB for a quadrilateral, 280 bytes here and the rest its corners and points, where
// the node itself, with the centre, normal and area of paper 4.2, takes 104. So patches are most of what a run holds while it has few
// links a node.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <radiosity/form_factor.hpp>

namespace radiosity {

struct QuadraturePoint {
  glm::dvec3 position{0.0};
  double weight = 0.0;  // area; the weights of a rule sum to the area of the patch
};

struct Patch {
  Polygon contour;         // counter-clockwise seen from the bright side, (nearly) planar; convex when there are no parts
  glm::dvec3 centre{0.0};  // mean of the corners
  glm::dvec3 normal{0.0};
  double area = 0.0;
  double radius = 0.0;                               // greatest distance of a corner from the centre
  glm::dvec3 centroid{0.0};                          // of the area
  glm::dmat3 inverse_inertia{0.0};                   // inverse, in the plane, of the mean of (x - centroid)(x - centroid)'
  std::vector<QuadraturePoint> rule2, rule3, rule4;  // 2x2, 3x3 and 4x4 Gauss points on each quadrilateral piece
  bool bent = false;                                 // its surface is curved, and normals turn over it:
  glm::dmat3 bend{0.0};                              // by this, a length (bend.hpp)
  std::vector<Polygon> parts;                        // convex, of a contour that is not; holes are reached by bridges, run through twice
};

namespace detail {

// Gauss-Legendre product rule on the quadrilateral a b c d (bilinear map; c == d gives a triangle). Exact for
// polynomials of degree 2n-1 on parallelograms. The weights use the area element along `normal`.
template <std::size_t N>
void append_gauss(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, const glm::dvec3& normal,
                  const std::array<double, N>& x, const std::array<double, N>& w, std::vector<QuadraturePoint>& out) {
  if (out.empty()) { out.reserve(N * N); }  // most patches are one piece, and a run has many patches
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      const double u = x[i];
      const double v = x[j];
      const glm::dvec3 p = (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c);
      const glm::dvec3 du = (1.0 - v) * (b - a) + v * (c - d);
      const glm::dvec3 dv = (1.0 - u) * (d - a) + u * (c - b);
      const double weight = w[i] * w[j] * glm::dot(glm::cross(du, dv), normal);
      if (weight > 0.0) { out.push_back({p, weight}); }
    }
  }
}

// A unit vector perpendicular to the unit vector n.
[[nodiscard]] inline glm::dvec3 tangent(const glm::dvec3& n) {
  const glm::dvec3 a = glm::abs(n);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3{1, 0, 0} : a.y <= a.z ? glm::dvec3{0, 1, 0} : glm::dvec3{0, 0, 1};
  return glm::normalize(glm::cross(n, axis));
}

// Abscissae and weights on [0, 1].
inline constexpr std::array<double, 2> gauss2_x{0.21132486540518711775, 0.78867513459481288225};
inline constexpr std::array<double, 2> gauss2_w{0.5, 0.5};
inline constexpr std::array<double, 3> gauss3_x{0.11270166537925831148, 0.5, 0.88729833462074168852};
inline constexpr std::array<double, 3> gauss3_w{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
inline constexpr std::array<double, 4> gauss4_x{0.06943184420297371239, 0.33000947820757186760, 0.66999052179242813240,
                                                0.93056815579702628761};
inline constexpr std::array<double, 4> gauss4_w{0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                                                0.17392742256872692869};

// Centroid and inverse inertia from the 3x3 rule, which is exact for these moments.
inline void set_inertia(Patch& patch) {
  const glm::dvec3 t = tangent(patch.normal);
  const glm::dvec3 s = glm::cross(patch.normal, t);
  double area = 0.0;
  for (const QuadraturePoint& q : patch.rule3) {
    patch.centroid += q.weight * (q.position - patch.centre);
    area += q.weight;
  }
  if (!(area > 0.0)) { return; }
  patch.centroid = patch.centroid / area + patch.centre;
  double tt = 0.0;
  double ts = 0.0;
  double ss = 0.0;
  for (const QuadraturePoint& q : patch.rule3) {
    const glm::dvec3 x = q.position - patch.centroid;
    tt += q.weight / area * glm::dot(x, t) * glm::dot(x, t);
    ts += q.weight / area * glm::dot(x, t) * glm::dot(x, s);
    ss += q.weight / area * glm::dot(x, s) * glm::dot(x, s);
  }
  const double determinant = tt * ss - ts * ts;
  if (!(determinant > 1e-20 * (tt + ss) * (tt + ss))) { return; }  // a needle: no slope
  patch.inverse_inertia =
      (ss * glm::outerProduct(t, t) - ts * (glm::outerProduct(t, s) + glm::outerProduct(s, t)) + tt * glm::outerProduct(s, s)) /
      determinant;
}

}  // namespace detail

// The vector area of a polygon (Newell): unit normal times area; independent of the starting corner up to rounding.
[[nodiscard]] inline glm::dvec3 vector_area(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) { sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]); }
  return 0.5 * sum;
}

namespace detail {

// Quadrilaterals around corner 0; a triangle is left over when the number of corners is odd.
inline void append_rules(Patch& patch, const Polygon& q) {
  for (std::size_t i = 1; i + 1 < q.size(); i += 2) {
    const glm::dvec3& last = i + 2 < q.size() ? q[i + 2] : q[i + 1];
    append_gauss(q[0], q[i], q[i + 1], last, patch.normal, gauss2_x, gauss2_w, patch.rule2);
    append_gauss(q[0], q[i], q[i + 1], last, patch.normal, gauss3_x, gauss3_w, patch.rule3);
    append_gauss(q[0], q[i], q[i + 1], last, patch.normal, gauss4_x, gauss4_w, patch.rule4);
  }
}

}  // namespace detail

// The patch with this contour; one that is not convex comes with its convex parts. A contour of no area gives a patch of area 0 without
// quadrature points.
[[nodiscard]] inline Patch make_patch(Polygon contour, std::vector<Polygon> parts = {}) {
  Patch patch;
  patch.contour = std::move(contour);
  patch.parts = std::move(parts);
  for (const glm::dvec3& p : patch.contour) { patch.centre += p / static_cast<double>(patch.contour.size()); }
  const glm::dvec3 area = vector_area(patch.contour);
  patch.area = glm::length(area);
  for (const glm::dvec3& p : patch.contour) { patch.radius = std::max(patch.radius, glm::length(p - patch.centre)); }
  if (!(patch.area > 0.0)) { return patch; }
  patch.normal = area / patch.area;
  if (patch.parts.empty()) { detail::append_rules(patch, patch.contour); }
  for (const Polygon& part : patch.parts) { detail::append_rules(patch, part); }
  detail::set_inertia(patch);
  return patch;
}

}  // namespace radiosity
