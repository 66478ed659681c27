// SPDX-License-Identifier: MIT
#pragma once

// Superquadrics (Barr 1981) about the z-axis: the superellipsoid
//
//      (|x/a|^p + |y/b|^p)^(q/p) + |z/c|^q <= 1,         p = 2 / around, q = 2 / profile,
//
// and, with a ring radius k > 1 (in units of a and b), the supertoroid, in which (|x/a|^p + |y/b|^p)^(1/p) - k stands in the place of the
// root. Exponents near 0 give boxes, 1 ellipsoids, 2 octahedra, more than 2 pinched shapes that shadow themselves. One sheet.
//
// Intersection, in units of the radii and from the point of the line nearest to the centre, clipped to the bounds. With A the gauge of
// (x, y) and B(z) the width of the profile (superellipse.hpp), the outer surface is f = A - k - B = 0 and the inner one f = k - A - B = 0.
// - Superellipsoid with p, q >= 1: its gauge is a norm, hence convex along a line, with two crossings at most: Newton from both sides.
// - Otherwise the line is cut where it meets x = 0, y = 0 and z = 0. Between these A and B are each convex or concave, and roots.hpp finds
//   all sign changes of their differences. Crossings are then found by Newton steps on the gauge of the profile.
// Crossings are known to 32 u (D + size) across the surface, with the cusps of pinched shapes as sharp as the coordinates: a blade or
// needle that is thinner than their rounding may be missed.

#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/roots.hpp>
#include <raycast/spans.hpp>
#include <raycast/superellipse.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

class Superquadric final : public Object {
 public:
  // ring = 0: a superellipsoid; otherwise above 1. Refused: non-finite or huge coordinates; radii that are not positive, vanish beside the
  // coordinates or differ by more than 1e6; exponents outside 0.001 to 10; another ring. Above 10 both sides of
  // a blade lie within 1e-8 of its length, as well as project() knows the nearest point, over more than its last eighth: vertices that are
  // put on one side come to lie on the other, and a mesh that is refined folds without end instead of following the surface.
  static Made<Superquadric> make(const glm::dvec3& centre, const glm::dvec3& radii, double profile, double around, double ring = 0.0);

  [[nodiscard]] bool convex() const override { return around_.convex() && profile_.convex() && ring_ == 0.0; }

  [[nodiscard]] bool nearest() const override { return false; }

  [[nodiscard]] double work() const override { return convex() ? 2.0 : 4.0; }

  [[nodiscard]] Box bounds() const override;

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override {
    const glm::dmat3 unit(1.0 / radii_.x, 0, 0, 0, 1.0 / radii_.y, 0, 0, 0, 1.0 / radii_.z);
    compiler.superquadric(centre_, unit, around_.p(), profile_.p(), ring_);
  }

  // Nearest, to 1e-8 of the size, for points that are nearer than the smallest radius of curvature; otherwise a point whose normal runs
  // towards p and that is no farther than the one where the way to the centre (of the profile) meets the surface. On an edge the normal
  // is the mean of both sides.
  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override;
  // In the planes of symmetry in which p lies: edges are curves in these.
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t, const glm::dvec3& p) const override;

  // A grid of trapezoids whose columns follow the superellipse about the axis and whose rows follow the profile, with triangles at the
  // poles of a superellipsoid. A chord point lies within the sum of both curves' chord errors of the surface, each scaled by the largest
  // extent of the other; either gets half of the tolerance. 4 (8 for a profile ring) to 512 points a curve.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  struct Piece {
    double in, leave;
  };
  using Cut = InlineVector<Piece, 8>;

  Superquadric(const glm::dvec3& centre, const glm::dvec3& radii, double profile, double around, double ring)
      : centre_(centre), radii_(radii), limit_(1.0 + ring, 1.0 + ring, 1.0), around_(2.0 / around), profile_(2.0 / profile), ring_(ring) {}

  // Cuts off what is outside of the planes between which pinched shapes lie. With p < 1, |x| + |y| is at most A(x, y), else the larger of
  // the two is; with q < 1 the same holds for |A| and |z|. Nothing is cut from other shapes.
  void clip_pinched(const glm::dvec3& f, const glm::dvec3& e, double& lo, double& hi) const;

  // The norm of the superellipsoid at f + s e, less one.
  [[nodiscard]] Sample norm(const glm::dvec3& f, const glm::dvec3& e, double s) const;

  // Newton's steps on a convex function from outside never pass its zero; where there is none, they come to where it rises.
  void cut_convex(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const;

  // A line in units of the radii, between two coordinate planes. A coordinate is measured from where the line meets its plane, so that it
  // is exactly 0 there.
  struct Line {
    glm::dvec3 f, e, zero;
    double lo, hi;
    [[nodiscard]] bool crosses(int k) const { return zero[k] > lo && zero[k] < hi; }
    [[nodiscard]] double at(int k, double s) const {
      return crosses(k) ? std::abs(e[k]) * std::abs(s - zero[k]) : std::abs(f[k] + s * e[k]);
    }
    // Change of |coordinate k| over the piece around `middle`.
    [[nodiscard]] double rate(int k, double middle) const { return std::signbit(f[k] + middle * e[k]) ? -e[k] : e[k]; }
  };

  void cut_pieces(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const;

  // Distance from the middle of the tube; 0 up to rounding, so that the edges of a pinched tube are edges.
  [[nodiscard]] double from_ring(double a) const { return std::abs(a - ring_) <= eps_ring * ring_ ? 0.0 : a - ring_; }

  // The point of the surface on the way from the centre of the profile to f >= 0, in lengths.
  [[nodiscard]] glm::dvec3 onto(const glm::dvec3& f) const;
  // The gauge of the profile at x >= 0, less one, and its gradient. A coordinate 0 has no part in the gradient: the two sides cancel.
  [[nodiscard]] std::pair<double, glm::dvec3> level(const glm::dvec3& x) const;
  [[nodiscard]] glm::dvec3 normal(const glm::dvec3& x) const;
  // The nearest point to f >= 0. From planes of symmetry it is looked for at coordinates of `least`; 0 keeps it in a plane.
  [[nodiscard]] glm::dvec3 nearest_to(const glm::dvec3& f, const glm::dvec3& least) const;
  // Onto the surface from x >= 0 nearby: by Newton's steps along the normal, because the way to the centre is long where a blade runs
  // along it, then exactly. A step keeps this share of each coordinate at least: beside a blade steps are too long, and with 0 they end in its
  // plane, where the side is forgotten.
  [[nodiscard]] glm::dvec3 settle(glm::dvec3 x, double kept) const;

  glm::dvec3 centre_{0.0}, radii_{0.0}, limit_{1.0};
  Superellipse around_, profile_;
  double ring_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/superquadric.cpp>
#endif
