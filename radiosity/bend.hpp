// SPDX-License-Identifier: MIT
#pragma once

// How the normals of a curved object turn over one of its patches. A patch is flat; light that falls on its surface, which is not, varies
// with the normal there:
//
//     n(x) = n + S (x - c)          S symmetric only on principal axes, in the plane of the patch; c the centroid
//
// is fitted to the true normals at the corners by least squares. What the fit leaves is of second order in the angle over which the patch
// bends. The mean of n(x) is the patch's own normal: light from one direction brings to the surface what it brings to the chord.

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <raycast/transform.hpp>

#include <radiosity/patch.hpp>

namespace radiosity {

// S of a patch whose corners lie on this sheet of the object; 0 where the corners do not tell (a needle).
[[nodiscard]] inline glm::dmat3 bend_of(const raycast::PlacedObject& object, std::uint32_t sheet, const Patch& patch) {
  const glm::dvec3 t = detail::tangent(patch.normal);
  const glm::dvec3 s = glm::cross(patch.normal, t);
  glm::dvec2 mean{0.0};
  Polygon normals;
  for (const glm::dvec3& x : patch.contour) {
    const glm::dvec3 n = object.project(sheet, x).normal;
    normals.push_back(n);
    mean += glm::dvec2{glm::dot(n, t), glm::dot(n, s)} / static_cast<double>(patch.contour.size());
  }
  glm::dmat2 moments{0.0};  // of n and of the place
  glm::dmat2 places{0.0};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 d = patch.contour[i] - patch.centre;
    const glm::dvec2 place{glm::dot(d, t), glm::dot(d, s)};
    moments += glm::outerProduct(glm::dvec2{glm::dot(normals[i], t), glm::dot(normals[i], s)} - mean, place);
    places += glm::outerProduct(place, place);
  }
  const double trace = places[0][0] + places[1][1];
  if (!(glm::determinant(places) > 1e-20 * trace * trace)) { return glm::dmat3{0.0}; }
  const glm::dmat2 fit = moments * glm::inverse(places);
  const glm::dvec3 of_t = fit[0][0] * t + fit[0][1] * s;  // how n changes along t
  const glm::dvec3 of_s = fit[1][0] * t + fit[1][1] * s;
  return glm::outerProduct(of_t, t) + glm::outerProduct(of_s, s);
}

// The normal of the surface over the point x of the patch.
[[nodiscard]] inline glm::dvec3 normal_over(const Patch& patch, const glm::dvec3& x) {
  return patch.bent ? glm::normalize(patch.normal + patch.bend * (x - patch.centroid)) : patch.normal;
}

}  // namespace radiosity
