// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/patch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

namespace detail {

// Gauss-Legendre product rule on a quadrilateral (bilinear map; equal corners 2 and 3 give a triangle). Exact for
// polynomials of degree 2n-1 on parallelograms. The weights use the area element along `normal`.
template <std::size_t N>
void append_gauss(const std::array<glm::dvec3, 4>& corner, const glm::dvec3& normal, const std::array<double, N>& x,
                  const std::array<double, N>& w, BigArray<QuadraturePoint>& out) {
  const auto& [a, b, c, d] = corner;
  if (out.empty()) { out.reserve(N * N); }  // most patches are a single piece
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

HALFLIGHT_INLINE glm::dvec3 tangent(const glm::dvec3& n) {
  const glm::dvec3 a = glm::abs(n);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3{1, 0, 0} : a.y <= a.z ? glm::dvec3{0, 1, 0} : glm::dvec3{0, 0, 1};
  return glm::normalize(glm::cross(n, axis));
}

// Abscissae and weights on [0, 1].
inline constexpr std::array<double, 2> gauss2_x{0.21132486540518711775, 0.78867513459481288225};

inline constexpr std::array<double, 2> gauss2_w{0.5, 0.5};

// Centroid and inverse inertia from the 3x3 rule, which is exact for these moments.
HALFLIGHT_INLINE void set_inertia(Patch& patch) {
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
  if (!(determinant > 1e-20 * (tt + ss) * (tt + ss))) { return; }  // a needle: no gradient is determined
  patch.inverse_inertia =
      (ss * glm::outerProduct(t, t) - ts * (glm::outerProduct(t, s) + glm::outerProduct(s, t)) + tt * glm::outerProduct(s, s)) /
      determinant;
}

}  // namespace detail

HALFLIGHT_INLINE glm::dvec3 vector_area(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) { sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]); }
  return 0.5 * sum;
}

namespace detail {

// Adds rules for quadrilaterals around corner 0, and a triangle if the number of corners is odd.
HALFLIGHT_INLINE void append_rules(Patch& patch, const Polygon& q) {
  for (std::size_t i = 1; i + 1 < q.size(); i += 2) {
    const std::array<glm::dvec3, 4> piece{q[0], q[i], q[i + 1], i + 2 < q.size() ? q[i + 2] : q[i + 1]};
    append_gauss(piece, patch.normal, gauss2_x, gauss2_w, patch.rule2);
    append_gauss(piece, patch.normal, gauss3_x, gauss3_w, patch.rule3);
    append_gauss(piece, patch.normal, gauss4_x, gauss4_w, patch.rule4);
  }
}

}  // namespace detail

HALFLIGHT_INLINE Patch make_patch(Polygon contour, std::vector<Polygon> parts, std::pmr::memory_resource* arrays) {
  Patch patch;
  for (BigArray<QuadraturePoint>* const rule : {&patch.rule2, &patch.rule3, &patch.rule4}) { *rule = BigArray<QuadraturePoint>(arrays); }
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
