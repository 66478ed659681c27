// SPDX-License-Identifier: MIT
#include <radiosity/picture/lookup.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/bvh.hpp>
#include <raycast/object.hpp>
#include <raycast/point_query.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/chord.hpp>
#include <radiosity/picture/pass_through.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

HALFLIGHT_INLINE Lookup::Lookup(const Scene& scene, const Mesh& mesh, const Frame& frame)
    : frame_{frame}, objects_{compile(scene, frame)}, rounding_{256 * raycast::unit_roundoff * objects_.bounds().magnitude()} {
  const std::vector<InputSurface> inputs = surfaces(scene);
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].sheet == 0) { first_sheet_.push_back(i); }
  }
  sheets_.resize(inputs.size());
  corners_.resize(mesh.corners.size());
  std::vector<std::size_t> counts(inputs.size(), 0);
  for (const MeshFace& face : mesh.faces) { counts[face.surface] += face.corner_count - 2; }
  for (std::size_t i = 0; i < inputs.size(); ++i) { sheets_[i].triangles.reserve(counts[i]); }
  for (const MeshFace& face : mesh.faces) {
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      const glm::dvec3 position = (mesh.positions[mesh.corners[c].vertex] - frame.centre) * frame.scale;
      corners_[c] = {position, glm::dvec3{mesh.corners[c].normal}};
    }
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      Triangle triangle{{face.first_corner, face.first_corner + k, face.first_corner + k + 1}, 0.0f, {}};
      for (std::size_t i = 0; i < 3; ++i) { triangle.radiosity[i] = mesh.corners[triangle.corner[i]].radiosity; }
      sheets_[face.surface].triangles.push_back(triangle);
    }
  }
  find_coarse();
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    std::vector<raycast::Box> boxes;
    std::vector<PlaneGrid::Corners> corners;
    const raycast::PlacedObject& object = objects_.object(inputs[i].object);
    for (const Triangle& triangle : sheets_[i].triangles) {
      boxes.push_back(region(triangle, object, inputs[i].sheet));
      if (object.flat()) { corners.push_back(chord(triangle).position); }
    }
    sheets_[i].tree = raycast::Bvh(boxes, 8.0);  // Newton's method costs as much as testing several boxes
    sheets_[i].plane = PlaneGrid(corners);
  }
}

HALFLIGHT_INLINE ChordTriangle Lookup::chord(const Triangle& triangle) const {
  ChordTriangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.position[i] = corners_[triangle.corner[i]].position;
    result.normal[i] = corners_[triangle.corner[i]].normal;
  }
  return result;
}

HALFLIGHT_INLINE raycast::Box Lookup::region(const Triangle& triangle, const raycast::PlacedObject& object, std::uint32_t sheet) const {
  const ChordTriangle flat = chord(triangle);
  const auto& [a, b, c] = flat.position;
  raycast::Box box;
  for (const glm::dvec3& p : flat.position) { box.extend(p); }
  double distance = 0.0;
  if (!object.flat()) {
    for (const glm::dvec3& p : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0}) {
      distance = std::max(distance, glm::length(object.project(sheet, p).position - p));
    }
  }
  return box.grown(2.0 * (distance + object.slack()) + rounding_);
}

namespace detail {

// Relative difference of the corners' light, in the brightest, below which the light is considered constant.
inline constexpr double told_apart = 0.05;
// A surface that rises above a plane by the share least_rise of its width darkens the plane within `darkened` times its width; a triangle
// far_wider times as wide does not resolve that.
inline constexpr double least_rise = 0.05, darkened = 0.25, far_wider = 4.0;

// The height of the box above the plane through p.
[[nodiscard]] HALFLIGHT_INLINE double rise(const raycast::Box& box, const glm::dvec3& p, const glm::dvec3& normal) {
  const glm::dvec3 half = 0.5 * box.size();
  return glm::dot(box.centre() - p, normal) + glm::dot(half, glm::abs(normal));
}

}  // namespace detail

HALFLIGHT_INLINE void Lookup::find_coarse() {
  std::vector<std::uint32_t> others;  // sheets; with widths, positions, and the boxes within which they may darken others
  std::vector<double> widths;
  std::vector<raycast::Box> bounds, reached;
  for (std::uint32_t i = 0; i < sheets_.size(); ++i) {
    raycast::Box box;
    for (const Triangle& triangle : sheets_[i].triangles) {
      for (const std::uint32_t corner : triangle.corner) { box.extend(corners_[corner].position); }
    }
    if (box.empty()) { continue; }
    others.push_back(i);
    widths.push_back(box.diameter());
    bounds.push_back(box);
    reached.push_back(box.grown(detail::darkened * box.diameter()));
  }
  const raycast::Bvh tree{reached};
  for (std::uint32_t own = 0; own < sheets_.size(); ++own) {
    for (Triangle& triangle : sheets_[own].triangles) {
      double least = raycast::infinity, most = 0.0, longest = 0.0;
      raycast::Box box;
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner &a = corners_[triangle.corner[i]], &b = corners_[triangle.corner[(i + 1) % 3]];
        const double light = sum_of_channels(triangle.radiosity[i]);
        least = std::min(least, light);
        most = std::max(most, light);
        longest = std::max(longest, glm::length(b.position - a.position));
        box.extend(a.position);
      }
      double within = most - least > detail::told_apart * most ? longest : 0.0;
      const std::array<glm::dvec3, 3> corner = chord(triangle).position;
      const glm::dvec3 n = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      const auto meets = [&](const raycast::Box& other) { return other.meets(box); };
      const auto look = [&](std::uint32_t k) {
        const bool darkens =
            others[k] != own && meets(reached[k]) && detail::rise(bounds[k], corner[0], n) > detail::least_rise * widths[k];
        if (darkens && detail::far_wider * widths[k] < longest) { within = std::max(within, 2.0 * widths[k]); }
        return false;  // false: visit all
      };
      if (within == 0.0) { raycast::any_within(tree, meets, look); }
      triangle.coarse_within = static_cast<float>(within);
    }
  }
}

HALFLIGHT_INLINE Color Lookup::blend(const Triangle& triangle, const glm::dvec3& weight) const {
  Color sum{0.0};
  for (int i = 0; i < 3; ++i) { sum += weight[i] * triangle.radiosity[i]; }
  return sum;
}

HALFLIGHT_INLINE std::optional<Lookup::Found> Lookup::find(const raycast::ScenePoint& place) const {
  const Sheet& on = sheets_[surface(place.object, place.sheet)];
  const glm::dvec3& point = place.position;
  if (const auto held = on.plane.find(point)) {
    const Triangle& triangle = on.triangles[held->triangle];
    return Found{blend(triangle, held->weight), held->triangle, true, triangle.coarse_within};
  }
  // If several triangles contain the point, prefers one that faces the same way, and among those the nearest: the far side of a thin
  // solid and the area beyond a crease belong to the same sheet. On a common wall of two prisms both triangles give the same colour.
  const auto faces = [&](const ChordTriangle& flat) {
    const auto& [a, b, c] = flat.position;
    return glm::dot(glm::cross(b - a, c - a), place.normal) > 0.0;
  };
  constexpr double slip = 1e-9;
  const Triangle* best = nullptr;
  bool best_faces = false;
  ChordPoint foot;
  raycast::around(on.tree, point, [&](std::uint32_t i) {
    const ChordTriangle flat = chord(on.triangles[i]);
    const std::optional<ChordPoint> candidate = chord_point(flat, point);
    if (!candidate || candidate->depth() < -slip) { return; }
    const bool facing = faces(flat);
    if (best != nullptr && (facing < best_faces || (facing == best_faces && !(std::abs(candidate->offset) < std::abs(foot.offset))))) {
      return;
    }
    best = &on.triangles[i];
    best_faces = facing;
    foot = *candidate;
  });
  if (best != nullptr) {
    const glm::dvec3 weight = glm::max(foot.weight, 0.0);
    return Found{blend(*best, weight / (weight.x + weight.y + weight.z)), static_cast<std::uint32_t>(best - on.triangles.data()), true,
                 best->coarse_within};
  }
  const auto nearest = raycast::nearest(on.tree, point, [&](std::uint32_t i) {
    const ChordTriangle flat = chord(on.triangles[i]);
    const glm::dvec3 w = nearest_in_triangle(flat.position, point);
    const glm::dvec3 gap = w.x * flat.position[0] + w.y * flat.position[1] + w.z * flat.position[2] - point;
    return glm::dot(gap, gap) * (faces(flat) ? 1.0 : 16.0);
  });
  if (!nearest) { return std::nullopt; }
  const Triangle& triangle = on.triangles[*nearest];
  return Found{blend(triangle, nearest_in_triangle(chord(triangle).position, point)), *nearest, false, triangle.coarse_within};
}

HALFLIGHT_INLINE std::optional<Color> Lookup::seen(const glm::dvec3& eye, const glm::dvec3& direction) const {
  const auto found = seen16(eye, std::span(&direction, 1))[0];
  if (!found) { return std::nullopt; }
  return found->radiosity;
}

HALFLIGHT_INLINE std::array<std::optional<Lookup::Seen>, 16> Lookup::seen16(const glm::dvec3& eye,
                                                                            std::span<const glm::dvec3> directions) const {
  std::array<std::optional<Seen>, 16> result;
  raycast::Segments16 rays;
  for (unsigned i = 0; i < directions.size(); ++i) {
    rays.set(i, {(eye - frame_.centre) * frame_.scale, directions[i]}, raycast::no_object, raycast::no_object);
  }
  pass_through(objects_, rays, [&](unsigned i, const raycast::Hit& hit, const raycast::Segment& ray, int) -> std::optional<glm::dvec3> {
    const raycast::ScenePoint place = objects_.point(hit, ray);
    const std::optional<Color> color = shade(hit, place);
    if (!color) { return place.position; }
    result[i] = Seen{first_sheet_[hit.object] + hit.sheet, *color};
    return std::nullopt;
  });
  return result;
}

}  // namespace radiosity
