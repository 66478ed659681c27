// SPDX-License-Identifier: MIT
#pragma once

// The points that bound a scene, in a tree: which of them lie above a plane is asked for every outer surface, and a scene may have many.
// Objects with plane faces are bounded by their vertices, others by the corners of their bounds.

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/bvh.hpp>

#include <radiosity/surface.hpp>

namespace radiosity {

class Extremes {
 public:
  Extremes() = default;
  explicit Extremes(const std::vector<Surface>& surfaces) {
    for (const Surface& surface : surfaces) {
      if (surface.object->exact()) {
        for (const brep::VertexId v : brep::vertices(surface.brep)) { points_.push_back(surface.brep.data(v).position); }
      } else {
        for (int corner = 0; corner < 8; ++corner) { points_.push_back(corner_of(surface.object->bounds(), corner)); }
      }
    }
    std::vector<raycast::Box> boxes;
    boxes.reserve(points_.size());
    for (const glm::dvec3& p : points_) { boxes.push_back({p, p}); }
    tree_ = raycast::Bvh{boxes};
  }

  // Does any point lie more than `slack` above the plane through `point` with this normal? A walk down a tree, but for scenes of which
  // very much lies in the plane.
  [[nodiscard]] bool any_above(const glm::dvec3& point, const glm::dvec3& normal, double slack) const {
    if (tree_.empty()) { return false; }
    const auto above = [&](const glm::dvec3& p) { return glm::dot(normal, p - point) > slack; };
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
      const raycast::Bvh::Node& node = tree_.nodes()[stack.back()];
      stack.pop_back();
      const int highest = (normal.x > 0.0 ? 1 : 0) + (normal.y > 0.0 ? 2 : 0) + (normal.z > 0.0 ? 4 : 0);
      if (!above(corner_of(node.box, highest))) { continue; }
      if (node.count == 0) {
        stack.insert(stack.end(), {node.first, node.first + 1});
        continue;
      }
      for (const std::uint32_t item : tree_.items(node)) {
        if (above(points_[item])) { return true; }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] static glm::dvec3 corner_of(const raycast::Box& box, int corner) {
    return {corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
  }

  std::vector<glm::dvec3> points_;
  raycast::Bvh tree_;
};

}  // namespace radiosity
