// SPDX-License-Identifier: MIT
#pragma once

// A leaf of a CSG tree on its way to the grid: vertices are snapped, faces get planes, bridge edges go.
//
// A face whose snapped vertices lie in one plane keeps all its vertices. Where one does not, there are two ways. If three faces meet at
// every vertex - boxes and prisms, however they are turned - the planes come first: the face takes the plane of its vertices before
// snapping, quantised to 2^-52 in its normal, and each vertex becomes the point of its three planes; faces stay whole polygons. Otherwise
// the faces that are not planar fall into triangles.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/wide.hpp>
#include <brep/result.hpp>

namespace brep::csg::detail {

class Leaf {
 public:
  struct Corner {
    std::uint32_t vertex, next, prev, twin, face;
  };
  std::vector<glm::dvec3> vertices;   // in spacings, not rounded
  std::vector<Corner> corners;        // half-edges with the bridges
  std::vector<std::uint32_t> anchor;  // of each face: one of its corners
  std::vector<std::uint32_t> given;   // face of the leaf -> index of the face of the BRep, which changes by triangles

  explicit Leaf(PlaneTable& planes) : planes_(planes) {}

  // Fills `boundary`, whose faces are those of the leaf; attributes are the faces' indices in the BRep.
  [[nodiscard]] Refusal run(Boundary& boundary);

 private:
  using Grid3 = std::array<std::int64_t, 3>;

  [[nodiscard]] Grid3 snapped(std::uint32_t vertex) const;
  [[nodiscard]] bool is_bridge(std::uint32_t c) const { return corners[c].face == corners[corners[c].twin].face; }

  // Vertices at one place are one point.
  void number_points();

  [[nodiscard]] Refusal check_edges(std::uint32_t f) const;

  // Newell's sum of the snapped vertices: exact, the normal times twice the area.
  [[nodiscard]] std::array<Int128, 3> newell(std::uint32_t f) const;
  // The plane on which all snapped vertices of the face lie, looking outwards.
  [[nodiscard]] std::optional<OrientedPlane> snapped_plane(std::uint32_t f) const;

  // Do three faces meet at every vertex?
  [[nodiscard]] bool is_simple() const;

  // What the corners of a face say about its plane before snapping.
  struct Mean {
    glm::dvec3 origin{0.0}, normal{0.0}, middle{0.0};  // a corner, twice the area, sum of the others from there
    double count = 0.0;
    bool level[3] = {true, true, true};  // one coordinate is the same all over: then the snapped plane is right, and meets others like it
  };
  [[nodiscard]] std::vector<Mean> means() const;

  // Gives every face a plane and every vertex the point of its three; false, and nothing changes, when that moves a vertex by more than a
  // spacing.
  bool place_by_planes();

  [[nodiscard]] Refusal triangulate();
  // The corner c becomes the middle of a triangle of its own. Its face goes on with a half-edge from the corner before it to the one after,
  // which is returned.
  std::uint32_t cut_off(std::uint32_t c);

  void strip_bridges();

  void emit(Boundary& boundary);
  // A plane through an edge between two faces of one plane; both its ends lie on the grid.
  [[nodiscard]] PlaneNumber upright(const Point& p, const Point& q, PlaneNumber plane);

  PlaneTable& planes_;
  std::vector<std::uint32_t> point_;  // of each vertex
  std::vector<Point> points_;
  std::vector<OrientedPlane> plane_;  // of each face
  std::vector<std::uint8_t> gone_;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/leaf.cpp>
#endif
