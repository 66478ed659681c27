// SPDX-License-Identifier: MIT
#pragma once

// Superquadrics (Barr 1981) about the z-axis: the superellipsoid
//
//      (|x/a|^p + |y/b|^p)^(q/p) + |z/c|^q <= 1,         p = 2 / around, q = 2 / profile,
//
// and, with a ring radius k > 1 (in units of a and b), the supertoroid, in which (|x/a|^p + |y/b|^p)^(1/p) - k replaces the root.
// Exponents near 0 give boxes, 1 ellipsoids, 2 octahedra, more than 2 pinched shapes that shadow themselves. One sheet.
//
// Intersection: in units of the radii, from the point of the line nearest to the centre, clipped to the bounds. Let A be the gauge of
// (x, y) and B(z) the width of the profile (superellipse.hpp); the outer surface is f = A - k - B = 0, the inner one f = k - A - B = 0.
// - A superellipsoid with p, q >= 1: its gauge is a norm, hence convex along a line with at most two crossings; Newton from both sides.
// - Otherwise the line is divided where it meets x = 0, y = 0 and z = 0. In between, A and B are each convex or concave, and roots.hpp
//   finds all sign changes of their differences. The crossings are then found by Newton's method on the gauge of the profile.
// Crossings are known to 32 u (D + size) perpendicular to the surface, and the cusps of pinched shapes are as sharp as the coordinates
// are precise: a blade or needle thinner than their rounding may be missed.

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

namespace raycast {

class Superquadric final : public Object {
 public:
  // ring = 0: a superellipsoid; otherwise above 1. Refuses: non-finite or huge coordinates; radii that are not positive, are negligible
  // beside the coordinates or differ by a factor above 1e6; exponents outside 0.001 to 10; any other ring. Above 10, more than the last
  // eighth of a blade is thinner than 1e-8 of its length, the precision to which project() knows the nearest point: vertices projected to
  // one side end up on the other, and mesh refinement folds without end instead of following the surface.
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

  // For points closer than the smallest radius of curvature, the nearest point, to 1e-8 of the size. Otherwise a point whose normal
  // points towards p and that is no farther than where the line from p to the centre (of the profile) meets the surface. On an edge the
  // normal is the mean of those of both sides.
  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override;
  // Keeps p in the planes of symmetry in which it lies, because edges are curves in these planes.
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t, const glm::dvec3& p) const override;

  // A grid of trapezoids whose columns follow the superellipse about the axis and whose rows follow the profile, with triangles at the
  // poles of a superellipsoid. A point on a chord is within the sum of both curves' chord errors of the surface, each scaled by the
  // largest extent of the other; each gets half of the tolerance. A curve has 4 (8 for a profile ring) to 512 points.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  struct Piece {
    double in, leave;
  };
  using Cut = InlineVector<Piece, 8>;

  Superquadric(const glm::dvec3& centre, const glm::dvec3& radii, double profile, double around, double ring)
      : centre_(centre), radii_(radii), limit_(1.0 + ring, 1.0 + ring, 1.0), around_(2.0 / around), profile_(2.0 / profile), ring_(ring) {}

  // Clips the line to the planes that bound pinched shapes: with p < 1, |x| + |y| is at most A(x, y), else the larger of the two is; with
  // q < 1 the same holds for |A| and |z|. Other shapes are not clipped.
  void clip_pinched(const glm::dvec3& f, const glm::dvec3& e, double& lo, double& hi) const;

  // The norm of the superellipsoid at f + s e, minus one.
  [[nodiscard]] Sample norm(const glm::dvec3& f, const glm::dvec3& e, double s) const;

  // From outside, Newton's steps on a convex function never pass its zero; if there is none, they arrive where the function rises.
  void cut_convex(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const;

  // A line in units of the radii, between two coordinate planes. Each coordinate is measured from where the line meets its plane, so that
  // it is exactly 0 there.
  struct Line {
    glm::dvec3 f, e, zero;
    double lo, hi;
    [[nodiscard]] bool crosses(int k) const { return zero[k] > lo && zero[k] < hi; }
    [[nodiscard]] double at(int k, double s) const {
      return crosses(k) ? std::abs(e[k]) * std::abs(s - zero[k]) : std::abs(f[k] + s * e[k]);
    }
    // Derivative of |coordinate k| on the piece around `middle`.
    [[nodiscard]] double rate(int k, double middle) const { return std::signbit(f[k] + middle * e[k]) ? -e[k] : e[k]; }
  };

  void cut_pieces(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const;

  // Signed distance from the middle of the tube; exactly 0 if that is within rounding, so that the edges of a pinched tube are recognized.
  [[nodiscard]] double from_ring(double a) const { return std::abs(a - ring_) <= eps_ring * ring_ ? 0.0 : a - ring_; }

  // The point of the surface on the line from the centre of the profile to f >= 0, in lengths.
  [[nodiscard]] glm::dvec3 onto(const glm::dvec3& f) const;
  // The gauge of the profile at x >= 0, minus one, and its gradient. A coordinate 0 contributes nothing to the gradient, because both
  // sides cancel.
  [[nodiscard]] std::pair<double, glm::dvec3> level(const glm::dvec3& x) const;
  [[nodiscard]] glm::dvec3 normal(const glm::dvec3& x) const;
  // The nearest point to f >= 0. The search also starts with coordinates of at least `least`, to leave planes of symmetry; 0
  // stays in a plane.
  [[nodiscard]] glm::dvec3 nearest_to(const glm::dvec3& f, const glm::dvec3& least) const;
  // Projects a point x >= 0 near the surface onto it: first by Newton's steps along the normal, because the line to the centre is long if
  // a blade runs along it; then exactly, by onto(). A step keeps at least the share `kept` of each coordinate: beside a blade steps are
  // too long, and with 0 they end in its plane, where it is no longer known on which side they were.
  [[nodiscard]] glm::dvec3 settle(glm::dvec3 x, double kept) const;

  glm::dvec3 centre_{0.0}, radii_{0.0}, limit_{1.0};
  Superellipse around_, profile_;
  double ring_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/superquadric.cpp>
#endif
