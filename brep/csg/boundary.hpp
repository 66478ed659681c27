// SPDX-License-Identifier: MIT
#pragma once

// How a solid is held between operations: points, half-edges and faces in flat arrays.
//
// A face is a connected piece of a plane with any number of boundary cycles; no bridge edges here, they carry no geometry and come back in
// to_brep. Half-edges of a face lie side by side in memory; `next` tells the cycles apart. The face lies on the left, seen from outside.
// `across` is a second plane through the edge: with the plane of the face it names the line. Twins belong to one solid wedge, so where
// two parts of a solid touch along an edge there are two edges with the same two points.
//
// Invariants: points are geometrically different; edges have a point in common only at their ends, or they coincide; a point where two
// edges on one line meet is kept only where something else meets it. An edge that lies in a face of the same solid is an edge of that
// face, too: where a solid touches itself along an edge, the edges stay, even between neighbours in one plane or with one face on both
// sides. Other neighbours differ in plane or in attribute. Shells, genus and umbrellas at a point follow from the twins.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/csg/plane.hpp>

namespace brep::csg {

// A point of the grid, or the common point of three planes. In spacings, relative to the centre of the grid.
struct Point {
  glm::dvec3 position{0.0};             // of the grid: exact; else each coordinate rounded down to a multiple of 2^-27
  std::array<PlaneNumber, 3> planes{};  // planes[0] == invalid_index: a point of the grid

  [[nodiscard]] bool on_grid() const { return planes[0] == invalid_index; }
};

struct Half {
  std::uint32_t point;  // where it starts
  std::uint32_t next;
  std::uint32_t twin;
  std::uint32_t face;
  PlaneNumber across;
};

// In spacings, rounded outwards.
struct Box {
  std::array<std::int32_t, 3> lo{INT32_MAX, INT32_MAX, INT32_MAX}, hi{INT32_MIN, INT32_MIN, INT32_MIN};

  void add(const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) { lo[i] = lo[i] < b.lo[i] ? lo[i] : b.lo[i], hi[i] = hi[i] > b.hi[i] ? hi[i] : b.hi[i]; }
  }
  void add(const glm::dvec3& p, bool exact) {  // |p| < 2^25, exact or rounded down by less than 2^-27
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      const auto down = static_cast<std::int32_t>(p[i] + 0x1p25) - (1 << 25), up = exact ? down : down + 1;
      lo[axis] = lo[axis] < down ? lo[axis] : down;
      hi[axis] = hi[axis] > up ? hi[axis] : up;
    }
  }
  [[nodiscard]] bool meets(const Box& b) const {
    return lo[0] <= b.hi[0] && b.lo[0] <= hi[0] && lo[1] <= b.hi[1] && b.lo[1] <= hi[1] && lo[2] <= b.hi[2] && b.lo[2] <= hi[2];
  }
};

struct Face {
  OrientedPlane plane;
  std::uint32_t first = 0, count = 0;  // half-edges
  std::uint32_t attribute = 0;         // number of the value in the solid's list
  Box box;
};

struct Boundary {
  std::vector<Point> points;
  std::vector<Half> halves;
  std::vector<Face> faces;
  bool touching = false;  // perhaps there are edges that coincide
};

}  // namespace brep::csg
