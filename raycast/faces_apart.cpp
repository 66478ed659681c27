// SPDX-License-Identifier: MIT
#include <raycast/faces_apart.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

namespace detail {

// The unshared corners of two faces, and what they share: nothing, a corner, or corners along a straight line.
struct SharedCorners {
  std::vector<glm::dvec3> of_a, of_b;  // the other corners
  std::optional<glm::dvec3> point, edge;
};

HALFLIGHT_INLINE std::optional<SharedCorners> shared_corners(const MeshFace& a, const MeshFace& b, const std::vector<glm::dvec3>& positions,
                                                             double rounding) {
  SharedCorners result;
  std::vector<glm::dvec3> shared;
  const auto has = [](const MeshFace& face, std::uint32_t v) {
    return std::find(face.corners.begin(), face.corners.end(), v) != face.corners.end();
  };
  // Counts runs of consecutive shared corners; two runs mean two shared edges or corners.
  const auto rows = [&](const MeshFace& face, const MeshFace& other, std::vector<glm::dvec3>& rest) {
    std::size_t begins = 0;
    bool before = has(other, face.corners.back());
    for (const std::uint32_t v : face.corners) {
      const bool now = has(other, v);
      begins += now && !before;
      before = now;
      if (!now) { rest.push_back(positions[v]); }
    }
    return begins;
  };
  if (rows(a, b, result.of_a) > 1 || rows(b, a, result.of_b) > 1) { return std::nullopt; }
  if (result.of_a.empty() || result.of_b.empty()) { return std::nullopt; }  // the same corners
  for (const std::uint32_t v : a.corners) {
    if (has(b, v)) { shared.push_back(positions[v]); }
  }
  if (shared.empty()) { return result; }
  result.point = shared.front();
  if (shared.size() == 1) { return result; }
  const auto distance = [&](const glm::dvec3& p) { return glm::length(p - *result.point); };
  const auto farther = [&](const glm::dvec3& p, const glm::dvec3& q) { return distance(p) < distance(q); };
  const glm::dvec3 farthest = *std::max_element(shared.begin(), shared.end(), farther);
  if (!(distance(farthest) > 0.0)) { return std::nullopt; }
  result.edge = (farthest - *result.point) / distance(farthest);
  for (const glm::dvec3& p : shared) {  // shared corners that are not collinear form no edge
    if (glm::length(glm::cross(p - *result.point, *result.edge)) > rounding) { return std::nullopt; }
  }
  return result;
}

// Does a plane with this normal, through the shared corners, separate the two faces?
HALFLIGHT_INLINE bool divides(const SharedCorners& faces, glm::dvec3 normal, double rounding) {
  if (faces.edge) { normal -= glm::dot(normal, *faces.edge) * *faces.edge; }
  const double length = glm::length(normal);
  if (!(length > tol_between)) { return false; }
  normal /= length;
  const glm::dvec3 origin = faces.point.value_or(faces.of_a.front());
  const auto range = [&](const std::vector<glm::dvec3>& corners, double& low, double& high) {
    low = infinity, high = -infinity;
    for (const glm::dvec3& p : corners) {
      const double height = glm::dot(normal, p - origin);
      low = std::min(low, height), high = std::max(high, height);
    }
  };
  double low_a = 0.0, high_a = 0.0, low_b = 0.0, high_b = 0.0;
  range(faces.of_a, low_a, high_a);
  range(faces.of_b, low_b, high_b);
  if (!faces.point) { return low_a - high_b > 2 * rounding || low_b - high_a > 2 * rounding; }
  // One face lies well above the plane, the other below it, except for the deviation of its corners from its own plane.
  const auto above = [&](double low, double other_high) { return low > 0.0 && std::max(other_high, 0.0) + rounding <= tol_between * low; };
  return above(low_a, high_b) || above(low_b, high_a) || above(-high_a, -low_b) || above(-high_b, -low_a);
}

// Is there a separating plane between the convex hulls of two faces?
HALFLIGHT_INLINE bool hulls_apart(const MeshFace& a, const MeshFace& b, const std::vector<glm::dvec3>& positions, double rounding) {
  const std::optional<SharedCorners> shared = shared_corners(a, b, positions, rounding);
  if (!shared) { return false; }
  const auto divides = [&](const glm::dvec3& normal) { return detail::divides(*shared, normal, rounding); };
  if (divides(a.normal) || divides(b.normal)) { return true; }
  const auto along = [&](const MeshFace& face, std::size_t i) {  // the edge after corner i, as a unit vector
    const glm::dvec3 edge = positions[face.corners[(i + 1) % face.corners.size()]] - positions[face.corners[i]];
    return edge / std::max(glm::length(edge), smallest_length);
  };
  for (const MeshFace* face : {&a, &b}) {
    for (std::size_t i = 0; i < face->corners.size(); ++i) {
      if (divides(glm::cross(face->normal, along(*face, i)))) { return true; }
    }
  }
  if (shared->edge) {  // the plane through the shared edge that bisects the angle between both
    return divides(glm::normalize(shared->of_a.front() - *shared->point) - glm::normalize(shared->of_b.front() - *shared->point));
  }
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    for (std::size_t j = 0; j < b.corners.size(); ++j) {
      if (divides(glm::cross(along(a, i), along(b, j)))) { return true; }
    }
  }
  return false;
}

// Pairs of faces of a mesh, with triangles for those faces whose hull is not sufficient.
class FacePairs {
 public:
  FacePairs(const std::vector<MeshFace>& faces, const std::vector<glm::dvec3>& positions, double rounding)
      : faces_(faces), positions_(positions), rounding_(rounding) {}

  [[nodiscard]] Box bounds(std::span<const std::uint32_t> corners) const {
    Box box;
    for (const std::uint32_t v : corners) { box.extend(positions_[v]); }
    return box;
  }
  [[nodiscard]] bool apart(std::uint32_t f, std::uint32_t g) {
    if (hulls_apart(faces_[f], faces_[g], positions_, rounding_)) { return true; }
    if (faces_[f].corners.size() == 3 && faces_[g].corners.size() == 3) { return false; }
    const Triangles &of_f = triangles(f), &of_g = triangles(g);
    if (of_f.empty() || of_g.empty()) { return false; }
    const Box around_g = bounds(faces_[g].corners).grown(4 * rounding_);
    for (const Triangle& a : of_f) {
      const Box around_a = bounds(a).grown(4 * rounding_);
      if (!around_a.meets(around_g)) { continue; }
      for (const Triangle& b : of_g) {
        if (around_a.meets(bounds(b)) && !hulls_apart({a, faces_[f].normal}, {b, faces_[g].normal}, positions_, rounding_)) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  using Triangles = std::vector<Triangle>;

  // The triangles of a face; empty if they do not certainly cover it.
  const Triangles& triangles(std::uint32_t f) {
    const auto [entry, added] = cut_.try_emplace(f);
    if (!added) { return entry->second; }
    const std::span<const std::uint32_t> corners = faces_[f].corners;
    std::vector<glm::dvec3> polygon;
    for (const std::uint32_t v : corners) { polygon.push_back(positions_[v]); }
    for (const auto& [i, j, k] : brep::ears(polygon)) {
      const glm::dvec3 turn = glm::cross(polygon[j] - polygon[i], polygon[k] - polygon[i]);
      if (!(glm::dot(turn, faces_[f].normal) > 0.0)) {
        entry->second.clear();
        break;
      }
      entry->second.push_back({corners[i], corners[j], corners[k]});
    }
    return entry->second;
  }

  const std::vector<MeshFace>& faces_;
  const std::vector<glm::dvec3>& positions_;
  double rounding_;
  std::map<std::uint32_t, Triangles> cut_;
};

}  // namespace detail

HALFLIGHT_INLINE bool faces_apart(const std::vector<MeshFace>& faces, const std::vector<glm::dvec3>& positions, const Bvh& bvh,
                                  double rounding) {
  detail::FacePairs pairs(faces, positions, rounding);
  const auto count = static_cast<std::uint32_t>(faces.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    const Box box = pairs.bounds(faces[f].corners);
    const auto meets = [&](std::uint32_t g) { return g > f && !pairs.apart(f, g); };
    bool met = any_within(
        bvh, [&](const Box& other) { return other.meets(box); }, meets);
    for (std::uint32_t g = f + 1; bvh.empty() && g < count && !met; ++g) { met = meets(g); }
    if (met) { return false; }
  }
  return true;
}

}  // namespace raycast
