// SPDX-License-Identifier: MIT
#include <radiosity/visibility/leaf_locator.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/object.hpp>
#include <raycast/point_query.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

namespace detail {

// The least distance of x from the edges of a convex polygon, in its plane; negative outside. Where that is at most `enough`, the result
// is some number between the two.
[[nodiscard]] HALFLIGHT_INLINE double depth_within(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, const glm::dvec3& x,
                                                   double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size() && least > enough; ++i) {
    const glm::dvec3 edge = polygon[i + 1 < polygon.size() ? i + 1 : 0] - polygon[i];
    const double length = glm::length(edge);
    if (length > 0.0) { least = std::min(least, glm::dot(glm::cross(normal, edge), x - polygon[i]) / length); }
  }
  return least;
}

}  // namespace detail

HALFLIGHT_INLINE LeafLocator::LeafLocator(const Hierarchy& hierarchy, const Patches& patches, std::size_t surface_count)
    : hierarchy_{&hierarchy}, patches_{&patches}, faces_(surface_count), fan_of_(hierarchy.size(), no_node) {
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].is_cluster()) { continue; }
    if (is_input_face(hierarchy, i)) { faces_[hierarchy[i].surface].nodes.push_back(i); }
    add_fan(i);
  }
  for (InputFaces& faces : faces_) {
    if (faces.nodes.size() < 2) { continue; }
    std::vector<raycast::Box> boxes;
    for (const std::uint32_t i : faces.nodes) {
      raycast::Box box;
      for (const glm::dvec3& p : patches[i].contour) { box.extend(p); }
      // A curved surface departs from its patch by at most the tilt of its normals times the radius, a curved border from its chords by
      // the rim.
      boxes.push_back(box.grown(hierarchy[i].radius * (hierarchy[i].deviation + 1e-9) + hierarchy[i].rim));
    }
    faces.tree = raycast::Bvh{boxes};
  }
}

HALFLIGHT_INLINE void LeafLocator::add_fan(std::uint32_t node) {
  const Node& parent = (*hierarchy_)[node];
  if (parent.leaf() || parent.child_count != parent.corners || parent.child_count > 4) { return; }
  Fan fan;
  fan.count = parent.child_count;
  for (std::uint32_t k = 0; k < fan.count; ++k) {  // corners of child k: corner k, midpoint of edge k, centre, midpoint of edge k - 1
    const Polygon& child = (*patches_)[parent.first_child + k].contour;
    if (child.size() != 4 || (k > 0 && child[2] != fan.middle)) { return; }
    fan.middle = child[2];
    fan.across[k] = glm::cross((*patches_)[node].normal, child[1] - child[2]);
  }
  fan_of_[node] = static_cast<std::uint32_t>(fans_.size());
  fans_.push_back(fan);
}

HALFLIGHT_INLINE double LeafLocator::depth(std::uint32_t node, const glm::dvec3& x, double enough) const {
  const Patch& patch = (*patches_)[node];
  double most = -std::numeric_limits<double>::infinity();
  if (!(patch.area > 0.0)) { return most; }
  if (patch.parts.empty()) { return detail::depth_within(patch.contour, patch.normal, x, enough); }
  for (const Polygon& part : patch.parts) { most = std::max(most, detail::depth_within(part, patch.normal, x, std::max(most, enough))); }
  return most;
}

HALFLIGHT_INLINE std::uint32_t LeafLocator::input_face_at(const InputFaces& faces, const raycast::SurfacePoint& at) const {
  if (faces.nodes.size() < 2) { return faces.nodes.empty() ? no_node : faces.nodes.front(); }
  const Patches& patches = *patches_;
  const auto turned_away = [&](std::uint32_t i) {
    return (*hierarchy_)[i].deviation > 0.0 && glm::dot(patches[i].normal, at.normal) <= 0.0;
  };
  std::uint32_t best = no_node;
  double best_score = -std::numeric_limits<double>::infinity();
  raycast::around(faces.tree, at.position, [&](std::uint32_t k) {
    const std::uint32_t i = faces.nodes[k];
    if (turned_away(i)) { return; }
    const double height = std::abs(glm::dot(patches[i].normal, at.position - patches[i].centre));
    const double enough = best_score + height - 8.0 * raycast::unit_roundoff * (std::abs(best_score) + height);
    const double score = depth(i, at.position, enough) - height;
    if (score > best_score) {
      best = i;
      best_score = score;
    }
  });
  if (best != no_node) { return best; }
  const std::optional<std::uint32_t> nearest = raycast::nearest(faces.tree, at.position, [&](std::uint32_t k) {
    const glm::dvec3 d = patches[faces.nodes[k]].centre - at.position;
    return glm::dot(d, d) * (turned_away(faces.nodes[k]) ? 16.0 : 1.0);
  });
  return nearest ? faces.nodes[*nearest] : no_node;
}

HALFLIGHT_INLINE std::uint32_t LeafLocator::child_at(std::uint32_t node, const glm::dvec3& x) const {
  const std::uint32_t first = (*hierarchy_)[node].first_child;
  if (fan_of_[node] != no_node) {
    const Fan& fan = fans_[fan_of_[node]];
    const glm::dvec3 d = x - fan.middle;
    double before = glm::dot(fan.across[fan.count - 1], d);
    for (std::uint32_t k = 0; k < fan.count; ++k) {
      const double after = glm::dot(fan.across[k], d);
      if (before >= 0.0 && after < 0.0) { return first + k; }
      before = after;
    }
    return first;  // the point is the centre itself
  }
  std::uint32_t best = first;
  double best_depth = depth(best, x, -std::numeric_limits<double>::infinity());
  for (std::uint32_t c = first + 1; c < first + (*hierarchy_)[node].child_count; ++c) {
    const double d = depth(c, x, best_depth);
    if (d > best_depth) {
      best = c;
      best_depth = d;
    }
  }
  return best;
}

HALFLIGHT_INLINE std::uint32_t LeafLocator::operator()(std::uint32_t surface, const raycast::SurfacePoint& at) const {
  std::uint32_t i = input_face_at(faces_[surface], at);
  while (i != no_node && !(*hierarchy_)[i].leaf()) { i = child_at(i, at.position); }
  return i;
}

}  // namespace radiosity
