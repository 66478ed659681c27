// SPDX-License-Identifier: MIT
#pragma once

// Is a point inside a solid? For the parts of an operand that have no common edge with the other one.
//
// A ray along +x from the point counts the faces that it meets, each by the parity of its edges around the ray. The ray is moved by an
// infinitesimal upwards and a smaller one sideways, v' = v + (0, e^2, e), so it meets no edge and no face along x; the point itself must
// not lie on the boundary. An edge on the planes p and q seen along x is the line a_q p - a_p q = b y + c z + d = 0: |b|, |c| < 2^107,
// |d| < 2^134. The point is a vertex, or the middle of two: |w| < 2^325, |x| < 2^352; so everything fits into 10 words.

#include <cstdint>

#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>

namespace brep::csg::detail {

struct Sample {
  glm::dvec3 position{0.0};  // wrong by less than 2^-26
  Homogeneous<10> exact;
};

class PointInSolid {
 public:
  PointInSolid(const Work& work, bool of_b) : work_(work), of_b_(of_b) {}

  [[nodiscard]] Sample vertex(std::uint32_t p) const { return {work_.points[p].position, widened(work_.points[p])}; }
  [[nodiscard]] Sample middle(std::uint32_t p, std::uint32_t q) const;

  // +1 inside, -1 outside, 0: the point lies on the boundary or looks so from infinity.     Time: the faces of the operand.
  [[nodiscard]] int operator()(const Sample& v) const;

 private:
  static constexpr double near = 0x1p-20;

  [[nodiscard]] Homogeneous<10> widened(const Point& p) const;

  // Does the line of the ray, without its direction, run through the face?
  [[nodiscard]] bool passes(const WorkFace& face, const Sample& v) const;
  // Not above the height of the ray?
  [[nodiscard]] bool below(const Point& a, const Sample& v) const;
  // Does the line of two planes pass the ray at a larger y?
  [[nodiscard]] static bool left(const Plane& p, const Plane& q, const Sample& v);
  [[nodiscard]] static int side(const Sample& v, const Plane& p);

  const Work& work_;
  bool of_b_;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/point_in_solid.cpp>
#endif
