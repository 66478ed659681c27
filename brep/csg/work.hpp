// SPDX-License-Identifier: MIT
#pragma once

// Both operands of one operation in one set of arrays, where they are cut along each other. The operands themselves stay as they are.
//
// The half-edges, faces and points of a come first, then those of b (turned inside out on request), then what the operation adds. A face
// that was touched keeps its half-edges in a list; the others have them side by side. Faces are connected: a face that falls into pieces
// becomes several.

#include <cstdint>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>

namespace brep::csg::detail {

struct WorkHalf {
  std::uint32_t point, next, prev, twin, face;
  PlaneNumber across;
};

struct WorkFace {
  OrientedPlane plane;
  std::uint32_t first = 0, count = 0;  // half-edges, or places in Work::lists
  std::uint32_t attribute = 0;
  bool of_b = false, listed = false;
  Box box;
};

struct Work {
  Predicates predicates;
  std::vector<Point> points;
  std::vector<WorkHalf> halves;
  std::vector<WorkFace> faces;
  std::vector<std::uint32_t> lists;
  std::uint32_t faces_a = 0, halves_given = 0;

  explicit Work(const PlaneTable& planes) : predicates(planes) {}

  // Appends a boundary, turned inside out if `reversed`; its attributes are numbered from `attributes` on.
  void add(const Boundary& b, bool of_b, bool reversed, std::uint32_t attributes);

  [[nodiscard]] std::uint32_t half(const WorkFace& f, std::uint32_t i) const { return f.listed ? lists[f.first + i] : f.first + i; }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const { return halves[halves[h].next].point; }
  [[nodiscard]] const Plane& plane(const WorkFace& f) const { return predicates.plane(f.plane.number()); }
  [[nodiscard]] const Point& from(std::uint32_t h) const { return points[halves[h].point]; }
  [[nodiscard]] const Point& to(std::uint32_t h) const { return points[target(h)]; }

  void link(std::uint32_t before, std::uint32_t after) {
    halves[before].next = after;
    halves[after].prev = before;
  }
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/work.cpp>
#endif
