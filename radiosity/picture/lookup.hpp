// SPDX-License-Identifier: MIT
#pragma once

// The solved radiosity as a function on the true objects: rays hit the objects themselves, not the mesh. The colour at a hit is taken
// from the corresponding triangle of the object's mesh (chord.hpp), interpolated between its corners as in mesh shading (paper 4.5). So
// silhouettes, rims and intersection curves are exact, while the colours are those of the reconstruction: exact at its vertices,
// continuous over every sheet, and on plane sheets identical.
//
// On a plane sheet, the triangle is found with a grid (plane_grid.hpp), on others with a tree over the triangles. A box of the tree
// contains the part of the true surface that its triangle represents: it is grown by twice the distance between the two, measured at the
// middle of the triangle and of its edges, where a paraboloid through the corners is farthest away. A point in no prism (beyond the chord
// of a cap's rim) takes the nearest point of the mesh.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/bvh.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/chord.hpp>
#include <radiosity/picture/plane_grid.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

class Lookup {
 public:
  // `mesh`: a solution of the scene, in scene coordinates; `frame`: that of the solution. Both may be destroyed after this.
  Lookup(const Scene& scene, const Mesh& mesh, const Frame& frame);

  // The radiosity at a point of a sheet, in coordinates of the frame. Nothing if the sheet is buried and has no mesh. Cost: one descent
  // of a tree, or a few steps in a grid.
  [[nodiscard]] std::optional<Color> at(std::uint32_t object, std::uint32_t sheet, const glm::dvec3& point) const {
    return at({{point, objects_.object(object).normal(sheet, point)}, object, sheet});
  }

  // At a place whose normal is known.
  [[nodiscard]] std::optional<Color> at(const raycast::ScenePoint& place) const {
    const std::optional<Found> found = find(place);
    return found ? std::optional(found->radiosity) : std::nullopt;
  }

  struct Found {
    Color radiosity{0.0};
    std::uint32_t triangle = 0;  // its index within the input surface
    bool within = false;         // does it correspond to the place? Otherwise it is only the nearest one
    double coarse_within = 0.0;  // seen from nearer than this, the triangle is too wide to represent its light; 0: never
  };
  [[nodiscard]] std::optional<Found> find(const raycast::ScenePoint& place) const;
  // What find() returns, up to rounding, at the point of a triangle of a flat object that has these barycentric weights.
  [[nodiscard]] Found found(std::uint32_t surface, std::uint32_t triangle, const glm::dvec3& weight) const {
    const Triangle& on = sheets_[surface].triangles[triangle];
    return {blend(on, weight), triangle, true, on.coarse_within};
  }

  // The triangles of an input surface, in the frame.
  [[nodiscard]] std::size_t triangle_count(std::uint32_t surface) const { return sheets_[surface].triangles.size(); }
  [[nodiscard]] ChordTriangle triangle(std::uint32_t surface, std::uint32_t k) const { return chord(sheets_[surface].triangles[k]); }
  [[nodiscard]] Color mean(std::uint32_t surface, std::uint32_t k) const {
    return blend(sheets_[surface].triangles[k], glm::dvec3{1.0 / 3.0});
  }

  [[nodiscard]] const raycast::Scene& objects() const { return objects_; }  // in the frame
  // As raycast::Scene::leave_out.
  void leave_out(std::span<const std::uint32_t> copies) { objects_.leave_out(copies); }
  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] std::uint32_t surface(std::uint32_t object, std::uint32_t sheet) const { return first_sheet_[object] + sheet; }

  // The radiosity seen from `eye` in `direction` (of any length), in scene coordinates: that of the first surface which shows its front
  // and is not buried under another object. Nothing if there is none. Back faces do not hide what lies behind them, so that one can look
  // into a room from outside, and out of a solid.
  [[nodiscard]] std::optional<Color> seen(const glm::dvec3& eye, const glm::dvec3& direction) const;

  struct Seen {
    std::uint32_t surface;  // index of the input surface
    Color radiosity{0.0};
  };
  // As above for up to sixteen directions; faster if they are close to each other.
  [[nodiscard]] std::array<std::optional<Seen>, 16> seen16(const glm::dvec3& eye, std::span<const glm::dvec3> directions) const;

 private:
  struct Corner {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
  };
  struct Triangle {
    std::uint32_t corner[3];
    float coarse_within = 0.0f;  // as in Found
    Color radiosity[3];          // at the corners; here and not in Corner, so that a point of a plane needs no other memory
  };
  struct Sheet {
    std::vector<Triangle> triangles;
    PlaneGrid plane;    // over the triangles of a plane sheet
    raycast::Bvh tree;  // over the triangles
  };

  // The radiosity at a hit; nothing at a back face, or if another object covers the place.
  [[nodiscard]] std::optional<Color> shade(const raycast::Hit& hit, const raycast::ScenePoint& place) const {
    if (!hit.front || objects_.covered(place)) { return std::nullopt; }
    return at(place);
  }
  [[nodiscard]] ChordTriangle chord(const Triangle& triangle) const;
  [[nodiscard]] raycast::Box region(const Triangle& triangle, const raycast::PlacedObject& object, std::uint32_t sheet) const;
  // Sets Triangle::coarse_within: the width of the triangle, if its corners differ; or twice the width of a much smaller surface that
  // rises from it, because such a surface darkens a part of the triangle of which the corners know nothing.
  void find_coarse();
  [[nodiscard]] Color blend(const Triangle& triangle, const glm::dvec3& weight) const;

  Frame frame_;
  raycast::Scene objects_;
  std::vector<std::uint32_t> first_sheet_;  // by object
  std::vector<Sheet> sheets_;               // by input surface
  std::vector<Corner> corners_;             // of the mesh, in the frame
  double rounding_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/lookup.cpp>
#endif
