// SPDX-License-Identifier: MIT
#pragma once

// The solved radiosity as a function on the true objects: what a ray sees, the mesh never being looked at for shape. A ray finds the
// point of an object; the colours come from the triangle of the object's mesh that stands for this point (chord.hpp), interpolated
// from its corners as the mesh itself is shaded (paper 4.5). So silhouettes, rims and the curves where objects meet are exact, while
// the colours are those of the reconstruction: exact at its vertices, continuous over every sheet, and on plane sheets the same.
//
// Each input surface has a tree over its triangles. A box holds the part of the true surface that its triangle stands for: it is
// grown by twice the distance between the two, measured at the middle of the triangle and of its edges, where a paraboloid through
// the corners is farthest away. A point in no prism (beyond the chord of a cap's rim) takes the nearest point of the mesh.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/point_query.hpp>
#include <raycast/scene.hpp>

#include <radiosity/chord.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/mesh.hpp>
#include <radiosity/scene.hpp>

namespace radiosity {

class Lookup {
 public:
  // `mesh` is a solution of the scene, in the scene's coordinates; `frame` that of the solution. Both inputs may go after this.
  Lookup(const Scene& scene, const Mesh& mesh, const Frame& frame);

  // The radiosity at a point of a sheet of an object, in the coordinates of the frame. Nothing where the sheet has no mesh because it
  // is buried. Cost: a walk down a tree.
  [[nodiscard]] std::optional<Color> at(std::uint32_t object, std::uint32_t sheet, const glm::dvec3& point) const {
    return at(object, sheet, {point, objects_.object(object).project(sheet, point).normal});
  }

  // What is seen from `eye` in `direction` (of any length), in the scene's coordinates: the first surface that shows its front and is
  // not buried under another object. Nothing where the ray meets none. Backs do not hide what lies behind them, so one looks into a
  // room from outside, and out of a solid.
  [[nodiscard]] std::optional<Color> seen(const glm::dvec3& eye, const glm::dvec3& direction) const;

  struct Seen {
    std::uint32_t surface;  // number of the input surface
    Color radiosity{0.0};
  };
  // As above in up to sixteen directions: faster when they are close to each other.
  [[nodiscard]] std::array<std::optional<Seen>, 16> seen16(const glm::dvec3& eye, std::span<const glm::dvec3> directions) const;

 private:
  struct Corner {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    Color radiosity{0.0};
  };
  struct Triangle {
    std::uint32_t corner[3];
  };
  struct Sheet {
    std::vector<Triangle> triangles;
    raycast::Bvh tree;  // over the triangles
  };

  // At a place of the sheet of which the normal is known.
  [[nodiscard]] std::optional<Color> at(std::uint32_t object, std::uint32_t sheet, const raycast::SurfacePoint& place) const;
  // Where a ray has met something: nothing at a back, and where another object covers the place.
  [[nodiscard]] std::optional<Color> shade(const raycast::Hit& hit, const raycast::SurfacePoint& place) const {
    if (!hit.front || objects_.covered(place.position, place.normal, hit.object)) { return std::nullopt; }
    return at(hit.object, hit.sheet, place);
  }
  [[nodiscard]] ChordTriangle chord(const Triangle& triangle) const;
  [[nodiscard]] raycast::Box region(const Triangle& triangle, const raycast::PlacedObject& object, std::uint32_t sheet) const;
  [[nodiscard]] Color blend(const Triangle& triangle, const glm::dvec3& weight) const;

  Frame frame_;
  raycast::Scene objects_;
  std::vector<std::uint32_t> first_sheet_;  // one an object
  std::vector<Sheet> sheets_;               // one an input surface
  std::vector<Corner> corners_;             // those of the mesh, in the frame
  double rounding_ = 0.0;
};

inline Lookup::Lookup(const Scene& scene, const Mesh& mesh, const Frame& frame)
    : frame_{frame}, objects_{compile(scene, frame)}, rounding_{256 * raycast::unit_roundoff * objects_.bounds().magnitude()} {
  const std::vector<InputSurface> inputs = surfaces(scene);
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].sheet == 0) { first_sheet_.push_back(i); }
  }
  sheets_.resize(inputs.size());
  corners_.resize(mesh.corners.size());
  for (const MeshFace& face : mesh.faces) {
    const InputSurface& input = inputs[face.surface];
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      const glm::dvec3 position = (mesh.positions[mesh.corners[c].vertex] - frame.centre) * frame.scale;
      corners_[c] = {position, objects_.object(input.object).project(input.sheet, position).normal, mesh.corners[c].radiosity};
    }
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      sheets_[face.surface].triangles.push_back({{face.first_corner, face.first_corner + k, face.first_corner + k + 1}});
    }
  }
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    std::vector<raycast::Box> boxes;
    for (const Triangle& triangle : sheets_[i].triangles) {
      boxes.push_back(region(triangle, objects_.object(inputs[i].object), inputs[i].sheet));
    }
    sheets_[i].tree = raycast::Bvh(boxes, 8.0);  // Newton's method takes as long as several boxes
  }
}

inline ChordTriangle Lookup::chord(const Triangle& triangle) const {
  ChordTriangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.position[i] = corners_[triangle.corner[i]].position;
    result.normal[i] = corners_[triangle.corner[i]].normal;
  }
  return result;
}

inline raycast::Box Lookup::region(const Triangle& triangle, const raycast::PlacedObject& object, std::uint32_t sheet) const {
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

inline Color Lookup::blend(const Triangle& triangle, const glm::dvec3& weight) const {
  Color sum{0.0};
  for (int i = 0; i < 3; ++i) { sum += weight[i] * corners_[triangle.corner[i]].radiosity; }
  return sum;
}

inline std::optional<Color> Lookup::at(std::uint32_t object, std::uint32_t sheet, const raycast::SurfacePoint& place) const {
  const Sheet& on = sheets_[first_sheet_[object] + sheet];
  const glm::dvec3& point = place.position;
  // Of several triangles one that faces the same way, and of these the nearer one: the far side of a thin solid, and beyond a crease, is
  // on the same sheet. On a common wall they agree.
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
    return blend(*best, weight / (weight.x + weight.y + weight.z));
  }
  const auto nearest = raycast::nearest(on.tree, point, [&](std::uint32_t i) {
    const ChordTriangle flat = chord(on.triangles[i]);
    const glm::dvec3 w = nearest_in_triangle(flat.position, point);
    const glm::dvec3 gap = w.x * flat.position[0] + w.y * flat.position[1] + w.z * flat.position[2] - point;
    return glm::dot(gap, gap) * (faces(flat) ? 1.0 : 16.0);
  });
  if (!nearest) { return std::nullopt; }
  const Triangle& triangle = on.triangles[*nearest];
  return blend(triangle, nearest_in_triangle(chord(triangle).position, point));
}

inline std::optional<Color> Lookup::seen(const glm::dvec3& eye, const glm::dvec3& direction) const {
  const auto found = seen16(eye, std::span(&direction, 1))[0];
  if (!found) { return std::nullopt; }
  return found->radiosity;
}

inline std::array<std::optional<Lookup::Seen>, 16> Lookup::seen16(const glm::dvec3& eye, std::span<const glm::dvec3> directions) const {
  std::array<std::optional<Seen>, 16> result;
  raycast::Segments16 rays;
  for (unsigned i = 0; i < directions.size(); ++i) {
    rays.set(i, {(eye - frame_.centre) * frame_.scale, directions[i]}, raycast::no_object, raycast::no_object);
  }
  constexpr int most = 10'000;  // surfaces passed: only backs and buried ones are, so this ends what rounding might not
  for (int passed = 0; passed < most && rays.lanes != 0; ++passed) {
    const raycast::Hits16 hits = objects_.closest16(rays);
    rays.lanes &= hits.met;
    for (std::uint32_t rest = rays.lanes; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Hit& hit = hits.hit[i];
      const raycast::Segment ray = rays.at(i);
      const raycast::SurfacePoint place = objects_.object(hit.object).project(hit.sheet, ray.at(hit.t));
      if (const std::optional<Color> color = shade(hit, place)) {
        result[i] = Seen{first_sheet_[hit.object] + hit.sheet, *color};
        rays.lanes &= ~(1u << i);
      } else {
        rays.set(i, {place.position, ray.direction}, hit.object, raycast::no_object);
      }
    }
  }
  return result;
}

}  // namespace radiosity
