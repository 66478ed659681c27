// SPDX-License-Identifier: MIT
#include <radiosity/intake/beside.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/line_query.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>

namespace radiosity::intake {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE raycast::Bvh bvh_of_faces(const Working& mesh) {
  std::vector<raycast::Box> boxes;
  for (const Face& face : mesh.faces) {
    raycast::Box box;
    for (const std::uint32_t v : face.corners) { box.extend(mesh.positions[v]); }
    boxes.push_back(box.grown(mesh.tolerance));
  }
  return raycast::Bvh(boxes);
}

}  // namespace detail

HALFLIGHT_INLINE FacesBeside::FacesBeside(Working& mesh, const Topology& topology)
    : mesh_(mesh), topology_(topology), shared_(mesh.positions.size(), false), bvh_(detail::bvh_of_faces(mesh)) {
  std::vector<std::uint32_t> component(mesh.positions.size(), none);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t v : mesh.faces[f].corners) {
      shared_[v] = shared_[v] || (component[v] != none && component[v] != topology.component[f]);
      component[v] = topology.component[f];
    }
  }
}

HALFLIGHT_INLINE std::vector<Contact> FacesBeside::contacts(std::uint32_t own, double reach) const {
  const glm::dvec3 normal = raycast::plane_of(mesh_.outline(mesh_.faces[own])).normal,
                   middle = brep::centroid(mesh_.outline(mesh_.faces[own]));
  const raycast::Segment through{middle - reach * normal, 2.0 * reach * normal};
  std::vector<Contact> contacts;
  static_cast<void>(raycast::any_along(bvh_, raycast::SlabTest(through), 0.0, 1.0, [&](std::uint32_t face) {
    if (topology_.component[face] == topology_.component[own]) { return false; }
    const raycast::Plane plane = raycast::plane_of(mesh_.outline(mesh_.faces[face]));
    const auto height = [&](const glm::dvec3& p) { return glm::dot(p - plane.point, plane.normal); };
    const std::vector<std::uint32_t>& corners = mesh_.faces[own].corners;
    const bool parallel =
        std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return std::abs(height(mesh_.positions[v])) <= reach; });
    const Contact contact{face, plane, height(middle), glm::dot(plane.normal, normal) < 0.0};
    if (!parallel || (!contact.opposite && contact.height > 4.0 * mesh_.tolerance)) { return false; }
    if (raycast::RayFrame(through).winding(mesh_.outline(mesh_.faces[face])) != 0) { contacts.push_back(contact); }
    return false;
  }));
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return std::tuple(std::abs(a.height), a.face) < std::tuple(std::abs(b.height), b.face);
  });
  return contacts;
}

HALFLIGHT_INLINE void FacesBeside::lay(std::uint32_t face, const Contact& contact, ChangeKind kind) const {
  for (const std::uint32_t v : mesh_.faces[face].corners) {
    const double height = glm::dot(mesh_.positions[v] - contact.plane.point, contact.plane.normal);
    if (shared_[v] || height == 0.0) { continue; }
    mesh_.positions[v] -= height * contact.plane.normal;
    if (std::abs(height) > 1e-3 * mesh_.tolerance) { mesh_.changed(kind, mesh_.faces[face].polygon, std::abs(height)); }
  }
}

}  // namespace radiosity::intake
