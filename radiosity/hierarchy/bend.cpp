// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/bend.hpp>

#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/corner_normal.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

HALFLIGHT_INLINE glm::dmat3 bend_of(const raycast::PlacedObject& object, std::uint32_t sheet, const Patch& patch) {
  const glm::dvec3 t = detail::tangent(patch.normal);
  const glm::dvec3 s = glm::cross(patch.normal, t);
  glm::dvec2 mean{0.0};
  Polygon normals;
  for (const glm::dvec3& x : patch.contour) {
    const glm::dvec3 n = corner_normal(object, sheet, x, patch.centroid);
    normals.push_back(n);
    mean += glm::dvec2{glm::dot(n, t), glm::dot(n, s)} / static_cast<double>(patch.contour.size());
  }
  glm::dmat2 moments{0.0};  // covariance of normal and position
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

}  // namespace radiosity
