// SPDX-License-Identifier: MIT
#include <radiosity/intake/layers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

#include <radiosity/geometry/form_factor.hpp>

namespace radiosity::intake {
namespace detail {

// The area that two coplanar polygons have in common. `normal`: of their plane.
[[nodiscard]] HALFLIGHT_INLINE double common_area(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, const glm::dvec3& normal) {
  double common = 0.0;
  const std::vector<std::array<std::uint32_t, 3>> parts = brep::ears(a), others = brep::ears(b);
  for (const auto& [i, j, k] : parts) {
    for (const auto& [u, v, w] : others) {
      std::array<glm::dvec3, 3> window{b[u], b[v], b[w]};
      if (glm::dot(brep::vector_area(window), normal) < 0.0) { std::swap(window[1], window[2]); }
      Polygon part{a[i], a[j], a[k]}, rest;
      for (std::size_t side = 0; side < 3 && part.size() >= 3; ++side) {
        const glm::dvec3 along = window[(side + 1) % 3] - window[side];
        rest.clear();
        clip_to_horizon(part, window[side], glm::cross(normal, along), rest);
        std::swap(part, rest);
      }
      if (part.size() >= 3) { common += brep::area(part); }
    }
  }
  return common;
}

class Layering {
 public:
  Layering(Working& mesh, std::span<const std::uint32_t> faces) : mesh_(mesh), faces_(faces) {
    for (const std::uint32_t f : faces) {
      raycast::Box box;
      for (const std::uint32_t v : mesh.faces[f].corners) { box.extend(mesh.positions[v]); }
      boxes_.push_back(box.grown(mesh.tolerance));
      areas_.push_back(brep::area(mesh.outline(mesh.faces[f])));
      planes_.push_back(raycast::plane_of(mesh.outline(mesh.faces[f])));
    }
    tree_ = raycast::Bvh{boxes_};
  }

  [[nodiscard]] std::vector<std::uint32_t> run() {
    std::vector<std::size_t> order(faces_.size());
    std::vector<std::uint32_t> layer(faces_.size(), 0);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return areas_[a] > areas_[b]; });
    std::vector<bool> placed(faces_.size(), false);
    for (const std::size_t i : order) {
      const auto look = [&](std::uint32_t k) {
        if (placed[k] && layer[k] >= layer[i] && boxes_[k].meets(boxes_[i]) && overlap(k, i)) { layer[i] = layer[k] + 1; }
        return false;  // false: visit all
      };
      raycast::any_within(
          tree_, [&](const raycast::Box& box) { return box.meets(boxes_[i]); }, look);
      placed[i] = true;
    }
    return layer;
  }

 private:
  [[nodiscard]] std::vector<glm::dvec3> outline(std::size_t i) {
    const std::span<const glm::dvec3> points = mesh_.outline(mesh_.faces[faces_[i]]);
    return {points.begin(), points.end()};
  }

  [[nodiscard]] bool overlap(std::size_t larger, std::size_t smaller) {
    const std::vector<std::uint32_t>& corners = mesh_.faces[faces_[smaller]].corners;
    const raycast::Plane& plane = planes_[larger];
    const bool in_plane = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return std::abs(glm::dot(mesh_.positions[v] - plane.point, plane.normal)) <= mesh_.tolerance;
    });
    if (!in_plane) { return false; }
    const std::vector<glm::dvec3> a = outline(larger), b = outline(smaller);
    return common_area(b, a, plane.normal) > 4.0 * mesh_.tolerance * brep::extent(b);
  }

  Working& mesh_;
  std::span<const std::uint32_t> faces_;
  std::vector<raycast::Box> boxes_;  // by place in faces_, as are the others
  std::vector<double> areas_;
  std::vector<raycast::Plane> planes_;
  raycast::Bvh tree_;
};

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::uint32_t> layers_of(Working& mesh, std::span<const std::uint32_t> faces) {
  if (faces.size() < 2) { return std::vector<std::uint32_t>(faces.size(), 0); }
  return detail::Layering(mesh, faces).run();
}

}  // namespace radiosity::intake
