// SPDX-License-Identifier: MIT
#include <radiosity/intake/t_joints.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/line_query.hpp>

namespace radiosity::intake {
namespace detail {

struct Side {
  std::uint32_t shell, low, high;  // low, high: its vertices
  std::uint32_t face, corner;      // the side begins at this corner

  [[nodiscard]] auto key() const { return std::tie(shell, low, high); }
};

// The sides of all faces, sorted by edge.
inline std::vector<Side> sides_of(const Working& mesh, std::uint32_t first_shell) {
  std::vector<Side> edges;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].shell < first_shell) { continue; }
    const std::vector<std::uint32_t>& corners = mesh.faces[f].corners;
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]);
      edges.push_back({mesh.faces[f].shell, low, high, f, i});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Side& a, const Side& b) { return std::tuple(a.key(), a.face, a.corner) < std::tuple(b.key(), b.face, b.corner); });
  return edges;
}

struct Joint {
  std::uint32_t face, corner;
  double along;
  std::uint32_t vertex;
};

}  // namespace detail

HALFLIGHT_INLINE void close_t_joints(Working& mesh, std::uint32_t first_shell) {
  const std::vector<detail::Side> edges = detail::sides_of(mesh, first_shell);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;  // shell and vertex, for the ends of edges with one face
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const detail::Side& e = edges[i];
    if ((i > 0 && edges[i - 1].key() == e.key()) || (i + 1 < edges.size() && edges[i + 1].key() == e.key())) { continue; }
    ends.emplace_back(e.shell, e.low);
    ends.emplace_back(e.shell, e.high);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  if (ends.empty()) { return; }
  std::vector<raycast::Box> boxes;
  for (const auto& [shell, v] : ends) { boxes.push_back(raycast::Box{mesh.positions[v], mesh.positions[v]}.grown(mesh.tolerance)); }
  const raycast::Bvh bvh(boxes);

  std::vector<detail::Joint> joints;
  for (const detail::Side& e : edges) {
    const std::vector<std::uint32_t>& corners = mesh.faces[e.face].corners;
    const std::uint32_t from = corners[e.corner], to = corners[e.corner + 1 < corners.size() ? e.corner + 1 : 0];
    const glm::dvec3 a = mesh.positions[from], along = mesh.positions[to] - a;
    const double length = glm::length(along);
    if (!(length > 2.0 * mesh.tolerance)) { continue; }
    static_cast<void>(raycast::any_along(bvh, raycast::SlabTest({a, along}), 0.0, 1.0, [&](std::uint32_t i) {
      const auto [shell, v] = ends[i];
      const glm::dvec3 p = mesh.positions[v] - a;
      const double t = glm::dot(p, along) / (length * length), beside = glm::length(p - t * along);
      const bool inner = t * length > mesh.tolerance && (1.0 - t) * length > mesh.tolerance;
      if (shell != e.shell || !inner || beside > mesh.tolerance || std::find(corners.begin(), corners.end(), v) != corners.end()) {
        return false;
      }
      joints.push_back({e.face, e.corner, t, v});
      mesh.changed(ChangeKind::t_joint, mesh.faces[e.face].polygon, beside);
      return false;
    }));
  }
  // Sorted from the last corner of a face to the first, and from the end of an edge to its beginning, so that insertions do not shift the
  // places of later ones.
  std::sort(joints.begin(), joints.end(), [](const detail::Joint& a, const detail::Joint& b) {
    return std::tie(a.face, b.corner, b.along, a.vertex) < std::tie(b.face, a.corner, a.along, b.vertex);
  });
  for (const detail::Joint& joint : joints) {
    std::vector<std::uint32_t>& corners = mesh.faces[joint.face].corners;
    if (std::find(corners.begin(), corners.end(), joint.vertex) != corners.end()) { continue; }  // it also lies on another edge of the face
    corners.insert(corners.begin() + joint.corner + 1, joint.vertex);
  }
}

}  // namespace radiosity::intake
