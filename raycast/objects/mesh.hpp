// SPDX-License-Identifier: MIT
#pragma once

// A polyhedral surface: indexed planar polygons, counter-clockwise seen from the air. Each face is a sheet of its own: f0 f1
// ... A closed mesh is a solid; an open one is a surface whose back is black.
//
// The watertight line test of planar.hpp finds the crossings. The sign of the winding number, not a dot product, tells entries from
// exits, and every line through a closed mesh has equally many of both. The k-th entry belongs to the k-th exit: in a surface that does
// not intersect itself they alternate, and where rounding swaps an exit and the next entry (a line over an edge), two overlapping spans
// are merged and a span of negative length is dropped, so there is no gap. Whether a closed mesh intersects itself is checked only for
// rooms, whose faces go to the single-precision kernels only if it does not. A convex mesh of up to 32 planes is clipped plane by plane
// instead.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Mesh final : public Object {
 public:
  // Corners of faces are indices into `positions`; positions without a face are left out. Refuses, with the number of the face or vertex
  // (from 0): an index out of range, a face that polygon_fault refuses, a surface that is not a manifold with consistent orientation, a
  // closed mesh that is inside out (its volume is not positive). `rounding` of the positions: see polygon_fault.
  static Made<Mesh> make(const std::vector<glm::dvec3>& positions, const std::vector<std::vector<std::uint32_t>>& faces,
                         double rounding = 0.0);

  // Takes the faces of a BRep whose vertices have a `.position`, in its order; faces with a `.sheet` of brep::no_sheet are
  // holes. Refuses as above; the numbers in the sentence count the faces that are not holes.
  template <class Shape>
  requires requires(const Shape& shape, brep::VertexId v) { shape.data(v).position; }
  static Made<Mesh> make(const Shape& shape) {
    std::vector<glm::dvec3> positions;
    std::map<brep::VertexId, std::uint32_t> number;
    for (const brep::VertexId v : brep::vertices(shape)) {
      number.emplace(v, static_cast<std::uint32_t>(positions.size()));
      positions.push_back(shape.data(v).position);
    }
    std::vector<std::vector<std::uint32_t>> faces;
    for (const brep::FaceId f : brep::faces(shape)) {
      if constexpr (requires { shape.data(f).sheet; }) {
        if (shape.data(f).sheet == brep::no_sheet) { continue; }
      }
      faces.emplace_back();
      for (const brep::HalfedgeId h : brep::halfedges_of(shape, f)) { faces.back().push_back(number.at(shape.vertex(h))); }
    }
    return make(positions, faces);
  }

  [[nodiscard]] Box bounds() const override { return box_; }
  [[nodiscard]] bool convex() const override { return convex_; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] bool solid() const override { return borders_.empty(); }
  [[nodiscard]] double slack() const override { return slack_; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return static_cast<std::uint32_t>(planes_.size()); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override { return names_[sheet]; }

  void spans(const Segment& line, Spans& out) const override {
    if (few_planes_) { return clip(line, out); }
    spans_between(line, -infinity, infinity, out);
  }
  // The crossings of a surface without inside are independent of each other; those of a solid are told apart by all crossings before them.
  void spans_near(const Segment& line, double t0, double t1, Spans& out) const override;

  void compile(Compiler& compiler) const override;

  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const override;
  [[nodiscard]] int winding(const Segment& line, std::uint32_t face) const override {
    double shift = 0.0;
    return winding(RayFrame(nearer(line, shift)), face);
  }

  // The mesh itself, whatever the tolerance; each border loop is closed by one face of brep::no_sheet.
  void approximate(double, brep::Builder& out) const override;

  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override {
    const Plane& plane = planes_[sheet];
    return {p - glm::dot(p - plane.point, plane.normal) * plane.normal, plane.normal};
  }

 private:
  Mesh() = default;
  // The spans of the line; for a surface without inside, those between t0 and t1 at least.
  void spans_between(const Segment& line, double t0, double t1, Spans& out) const;
  // The planes of a convex mesh, at most 33; the triangles of one flat side share one.
  [[nodiscard]] std::vector<Plane> distinct_planes() const;
  // For a convex solid with one plane per face: the part of the line behind all planes, computed from the middle of the mesh, as above.
  void clip(const Segment& line, Spans& out) const;
  [[nodiscard]] std::span<const std::uint32_t> corners(std::uint32_t f) const {
    if (triangles_) { return std::span<const std::uint32_t>(corners_).subspan(3 * std::size_t{f}, 3); }
    return std::span<const std::uint32_t>(corners_).subspan(first_corner_[f], first_corner_[f + 1] - first_corner_[f]);
  }
  [[nodiscard]] int winding(const RayFrame& frame, std::uint32_t f) const {
    const std::span<const std::uint32_t> face = corners(f);
    return frame.winding(face.size(), [&](std::size_t i) -> const glm::dvec3& { return positions_[face[i]]; });
  }
  [[nodiscard]] Segment nearer(const Segment& line, double& shift) const {
    shift = nearest_parameter(line, box_.centre());
    return {line.at(shift), line.direction};
  }
  // The parameter at which the line meets the plane of face f, clamped to the extent of the face along the line, because the quotient is
  // unbounded for a face seen edge-on. The plane of a triangle is computed from its corners, which are needed anyway; loading it would
  // take longer.
  [[nodiscard]] double crossing_near(const Segment& line, std::uint32_t f) const;
  [[nodiscard]] double volume() const;

  std::string take(const std::vector<glm::dvec3>& positions, const std::vector<std::vector<std::uint32_t>>& faces, double rounding);

  // Finds the border loops, and calls brep::close to check that the mesh is a manifold.
  std::string close_borders();
  [[nodiscard]] std::string place(std::uint32_t v) const {
    const glm::dvec3& p = positions_[v];
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
  }

  void prepare();

  // Is it certain that the surface of this solid does not intersect itself, and that entries and exits alternate on every line?
  [[nodiscard]] bool embedded() const;
  // By corner: the lowest number among the corners that are connected with it by edges.
  [[nodiscard]] std::vector<std::uint32_t> connected() const;
  // Do entries and exits alternate on a line through the middle of the face, which must be one of them?
  [[nodiscard]] bool alternates_at(std::uint32_t face) const;
  // Calls visit(crossing, winding) for the faces that the line crosses within [t0, t1].
  template <class Visit>
  void crossings(const Segment& line, double t0, double t1, Visit&& visit) const;

  std::vector<glm::dvec3> positions_;
  std::vector<std::uint32_t> corners_, first_corner_{0};
  std::vector<Plane> planes_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::uint32_t>> borders_;
  Bvh bvh_;
  Box box_;
  double slack_ = 0.0;
  bool triangles_ = false;  // are all faces triangles?
  bool convex_ = false, few_planes_ = false;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/mesh.cpp>
#endif
