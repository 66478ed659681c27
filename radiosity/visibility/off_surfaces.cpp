// SPDX-License-Identifier: MIT
#include <radiosity/visibility/off_surfaces.hpp>

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/tolerances.hpp>

namespace radiosity {

HALFLIGHT_INLINE glm::dvec3 off_surfaces(const raycast::Scene& objects, const glm::dvec3& eye) {
  constexpr double on_it = 1e-9, off_it = 1e-6;  // relative to the diameter
  const double near = on_it * objects.diameter() + 256 * raycast::unit_roundoff * objects.bounds().magnitude();
  std::vector<glm::dvec3> normals;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const glm::dvec3 reach = near * glm::dvec3(x, y, z);
        const raycast::Segment ray{eye - reach, 2.0 * reach};  // crosses what lies at the eye
        const auto hit = x != 0 || y != 0 || z != 0 ? objects.closest(ray) : std::nullopt;
        if (!hit || hit->t > 1.0) { continue; }
        const glm::dvec3 normal = objects.point(*hit, ray).normal;
        constexpr double same = 0.999;
        if (std::none_of(normals.begin(), normals.end(), [&](const glm::dvec3& n) { return glm::dot(n, normal) > same; })) {
          normals.push_back(normal);
        }
      }
    }
  }
  glm::dvec3 away{0.0};
  for (const glm::dvec3& n : normals) { away += n; }
  if (!(glm::length(away) > 0.0)) { return eye; }
  away *= (off_it * objects.diameter() + 8.0 * near) / glm::length(away);
  const glm::dvec3 begin = eye + 0.25 * away;  // before the surfaces on which it lies
  const auto ahead = objects.closest({begin, away});
  return begin + (ahead && ahead->t < 1.0 ? 0.5 * ahead->t : 0.75) * away;
}

}  // namespace radiosity
