// SPDX-License-Identifier: MIT
#include <radiosity/intake/tilings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/planar.hpp>
#include <raycast/point_query.hpp>
#include <raycast/ray.hpp>

namespace radiosity::intake {
namespace detail {

// Finds the faces that divide a face into parts.
class Tilings {
 public:
  explicit Tilings(Working& mesh) : mesh_{mesh}, parts_(mesh.faces.size()), at_vertex_(mesh.positions.size() + 1, 0) {
    for (const Face& face : mesh.faces) {
      raycast::Box box;
      for (const std::uint32_t v : face.corners) { box.extend(mesh.positions[v]); }
      boxes_.push_back(box);
      areas_.push_back(brep::area(mesh.outline(face)));
      for (const std::uint32_t v : face.corners) { ++at_vertex_[v + 1]; }
    }
    std::partial_sum(at_vertex_.begin(), at_vertex_.end(), at_vertex_.begin());
    around_.resize(at_vertex_.back());
    std::vector<std::uint32_t> next = at_vertex_;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (const std::uint32_t v : mesh.faces[f].corners) { around_[next[v]++] = f; }
    }
  }

  // By face: its parts; empty if it is not divided. Of parts that are divided themselves only the parts count.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> run() {
    std::vector<std::uint32_t> order(mesh_.faces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas_[a] < areas_[b]; });
    for (const std::uint32_t f : order) {
      if (!may_be_divided(f)) { continue; }
      std::vector<std::uint32_t> within = faces_in(f);
      if (within.size() > 1 && cover_once(within, f)) { parts_[f] = std::move(within); }
    }
    return std::move(parts_);
  }

 private:
  static constexpr double clearly_less = 1e-6;  // of an area, as a share of it
  static constexpr std::size_t most_parts = 1000;

  // May `other` be a part of `face`? `reached`: the bounds of the latter, enlarged by the tolerance.
  [[nodiscard]] bool may_be_part(std::uint32_t other, std::uint32_t face, const raycast::Box& reached) const {
    return areas_[other] < (1.0 - clearly_less) * areas_[face] && reached.contains(boxes_[other].lo) &&
           reached.contains(boxes_[other].hi) && mesh_.faces[other].shell == mesh_.faces[face].shell;
  }

  // A corner of a divided face is a corner of one of its parts, too. So most faces need no search.
  [[nodiscard]] bool may_be_divided(std::uint32_t face) {
    const std::uint32_t corner = mesh_.faces[face].corners[0];
    const raycast::Box reached = boxes_[face].grown(mesh_.tolerance);
    std::optional<raycast::Plane> plane;
    for (std::uint32_t i = at_vertex_[corner]; i < at_vertex_[corner + 1]; ++i) {
      if (!may_be_part(around_[i], face, reached)) { continue; }
      if (!plane) { plane = raycast::plane_of(mesh_.outline(mesh_.faces[face])); }
      if (in_plane(around_[i], *plane)) { return true; }
    }
    return false;
  }

  // The smaller faces of its shell that lie in a face, up to most_parts. Of those with the same corners only one.
  [[nodiscard]] std::vector<std::uint32_t> faces_in(std::uint32_t face) {
    if (!tree_) { tree_.emplace(boxes_); }
    const raycast::Plane plane = raycast::plane_of(mesh_.outline(mesh_.faces[face]));
    const raycast::Box reached = boxes_[face].grown(mesh_.tolerance);
    std::vector<std::uint32_t> found;
    std::set<std::vector<std::uint32_t>> known;
    const auto look = [&](std::uint32_t other) {
      if (!may_be_part(other, face, reached) || !parts_[other].empty() || !lies_in(other, face, plane)) { return false; }
      std::vector<std::uint32_t> corners = mesh_.faces[other].corners;
      std::sort(corners.begin(), corners.end());
      if (known.insert(std::move(corners)).second) { found.push_back(other); }
      return found.size() > most_parts;
    };
    const bool too_many = raycast::any_within(
        *tree_, [&](const raycast::Box& box) { return box.meets(reached); }, look);
    if (too_many) { found.clear(); }
    std::sort(found.begin(), found.end());
    return found;
  }

  [[nodiscard]] bool in_plane(std::uint32_t face, const raycast::Plane& plane) const {
    const std::vector<std::uint32_t>& corners = mesh_.faces[face].corners;
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return std::abs(glm::dot(mesh_.positions[v] - plane.point, plane.normal)) <= mesh_.tolerance;
    });
  }

  // Does a face lie in the plane of a larger one, and a point inside it within that one's outline?
  [[nodiscard]] bool lies_in(std::uint32_t face, std::uint32_t larger, const raycast::Plane& plane) {
    if (!in_plane(face, plane)) { return false; }
    const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[face]);
    glm::dvec3 middle{0.0};  // of the largest triangle
    double most = 0.0;
    for (const auto& [a, b, c] : brep::ears(outline)) {
      const double size = glm::length(glm::cross(outline[b] - outline[a], outline[c] - outline[a]));
      if (!(size > most)) { continue; }
      most = size;
      middle = (outline[a] + outline[b] + outline[c]) / 3.0;
    }
    const double reach = 4.0 * mesh_.tolerance;
    const raycast::RayFrame across({middle - reach * plane.normal, 2.0 * reach * plane.normal});
    return most > 0.0 && across.winding(mesh_.outline(mesh_.faces[larger])) != 0;
  }

  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  void add_edges(std::uint32_t face, std::map<Edge, bool>& odd, double& length) const {
    const std::vector<std::uint32_t>& corners = mesh_.faces[face].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t from = corners[i], to = corners[i + 1 < corners.size() ? i + 1 : 0];
      bool& is = odd[std::minmax(from, to)];
      is = !is;
      length += glm::length(mesh_.positions[to] - mesh_.positions[from]);
    }
  }

  // If all edges of these faces and of `whole`, cut where others end on them, exist an even number of times, the faces cover each point of
  // `whole` an odd number of times. If their areas add up to its area, that number is one. A vertex may lie beside an edge by the
  // tolerance, which changes the area by at most that times the length of the edge.
  [[nodiscard]] bool cover_once(std::span<const std::uint32_t> within, std::uint32_t whole) const {
    double sum = 0.0, length = 0.0;
    std::map<Edge, bool> odd;
    for (const std::uint32_t part : within) {
      sum += areas_[part];
      add_edges(part, odd, length);
    }
    add_edges(whole, odd, length);
    if (!(std::abs(sum - areas_[whole]) <= mesh_.tolerance * length)) { return false; }
    std::erase_if(odd, [](const auto& of) { return !of.second; });
    std::set<std::uint32_t> vertices;
    for (const auto& [edge, is] : odd) { vertices.insert({edge.first, edge.second}); }
    std::map<Edge, bool> cut;
    for (const auto& [edge, is] : odd) {
      const std::vector<std::uint32_t> along = vertices_along(edge.first, edge.second, vertices);
      for (std::size_t k = 1; k < along.size(); ++k) {
        bool& is_odd = cut[std::minmax(along[k - 1], along[k])];
        is_odd = !is_odd;
      }
    }
    return std::none_of(cut.begin(), cut.end(), [](const auto& of) { return of.second; });
  }

  // Those of the vertices that lie on an edge, in order, with its ends: T-joints, too.
  [[nodiscard]] std::vector<std::uint32_t> vertices_along(std::uint32_t from, std::uint32_t to,
                                                          const std::set<std::uint32_t>& vertices) const {
    const glm::dvec3 &a = mesh_.positions[from], along = mesh_.positions[to] - a;
    const double length = glm::length(along);
    std::vector<std::pair<double, std::uint32_t>> on{{0.0, from}, {length, to}};
    for (const std::uint32_t v : vertices) {
      const double at = glm::dot(mesh_.positions[v] - a, along) / length;
      const bool beside = glm::length(mesh_.positions[v] - a - at / length * along) > mesh_.tolerance;
      if (at > 0.0 && at < length && !beside && v != from && v != to) { on.emplace_back(at, v); }
    }
    std::sort(on.begin(), on.end());
    std::vector<std::uint32_t> result;
    for (const auto& [at, v] : on) { result.push_back(v); }
    return result;
  }

  Working& mesh_;
  std::vector<std::vector<std::uint32_t>> parts_;  // by face
  std::vector<raycast::Box> boxes_;                // by face
  std::vector<double> areas_;                      // by face
  std::vector<std::uint32_t> at_vertex_, around_;  // the faces around vertex v: around_[at_vertex_[v]] and on, up to at_vertex_[v + 1]
  std::optional<raycast::Bvh> tree_;               // over the boxes; made when it is needed
};

}  // namespace detail

HALFLIGHT_INLINE void match_tilings(Working& mesh) {
  const std::vector<std::vector<std::uint32_t>> parts = detail::Tilings(mesh).run();
  if (std::all_of(parts.begin(), parts.end(), [](const auto& its) { return its.empty(); })) { return; }
  std::vector<Face> faces;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (parts[f].empty()) {
      faces.push_back(mesh.faces[f]);
      continue;
    }
    const glm::dvec3 up = brep::vector_area(mesh.outline(mesh.faces[f]));
    for (const std::uint32_t p : parts[f]) {
      Face part = mesh.faces[f];
      part.corners = mesh.faces[p].corners;
      if (glm::dot(brep::vector_area(mesh.outline(part)), up) < 0.0) { std::reverse(part.corners.begin(), part.corners.end()); }
      faces.push_back(std::move(part));
    }
  }
  mesh.faces = std::move(faces);
}

}  // namespace radiosity::intake
