// SPDX-License-Identifier: MIT
#pragma once

// The ring torus: a tube of the minor radius r around a circle of the major radius R > r. One sheet. A concave solid that illuminates and
// shadows itself.
//
// Intersection: in units of R, from the point of the line nearest to the centre, clipped to the sphere and the slab that contain the
// torus. There the implicit quartic has no cubic term,
//      (s^2 + k)^2 - 4 (a s^2 + 2 b s + c) = 0,      k = |f|^2 + 1 - r^2,  a s^2 + 2 b s + c = squared distance from the axis,
// so its extrema are the roots of s^3 + (k - 2 a) s - 2 b. Between two of them there is at most one crossing: the sign of the geometric
// function sqrt((distance from the axis - 1)^2 + z^2) - r decides, and bracketed Newton steps on this function find the crossing, so the
// quartic's coefficients have no influence on its precision. The value at the extremum decides whether a grazing line hits. Crossings are
// known to 32 u (D + R) perpendicular to the surface, and hit or miss is decided correctly if the line passes the surface at a larger
// distance.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/roots.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Torus final : public Object {
 public:
  // Refuses: non-finite or huge coordinates; a zero axis; a minor radius that is not positive, not below the major one, or below 1e-4 of
  // it; a torus that is negligible beside its centre's coordinates.
  static Made<Torus> make(const glm::dvec3& centre, const glm::dvec3& axis, double major, double minor);

  [[nodiscard]] Box bounds() const override;

  void spans(const Segment& line, Spans& out) const override;

  [[nodiscard]] double work() const override { return 1.0; }

  // False only if the line has two spans: then there are three extrema, the middle one outside.
  [[nodiscard]] bool passes_once(const Segment& line) const override;

  void compile(Compiler& compiler) const override {
    compiler.superquadric(centre_, frame_.into(minor_, minor_), 2.0, 2.0, major_ / minor_);
  }

  [[nodiscard]] SurfacePoint project(std::uint32_t, const glm::dvec3& p) const override;

  // n columns about the axis and m rows about the tube, multiples of 4 between 8 and 512, whose quadrilaterals are trapezoids. The chord
  // error of a cell is at most (dn^2 (R + r) + 2 dn dm r + dm^2 r) / 8 for angles dn, dm (Filip, Magedson, Markot 1986).
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  Torus(const glm::dvec3& centre, const glm::dvec3& axis, double major, double minor)
      : centre_(centre), frame_(axis), major_(major), minor_(minor) {}

  class Tube;
  // The line, from its point at `shift`, which is nearest to the centre.
  [[nodiscard]] Tube along(const Segment& line, double shift, double length) const {
    return Tube(frame_, (line.at(shift) - centre_) / major_, line.direction / length, minor_ / major_);
  }

  // The line f + s e in units of the major radius, e a unit vector perpendicular to f; its value is the signed distance from the tube of
  // radius r.
  class Tube {
   public:
    Tube(const AxisFrame& frame, const glm::dvec3& f, const glm::dvec3& e, double r)
        : f_(glm::dot(f, frame.u), glm::dot(f, frame.v), glm::dot(f, frame.w)),
          e_(glm::dot(e, frame.u), glm::dot(e, frame.v), glm::dot(e, frame.w)),
          r_(r) {}

    [[nodiscard]] Sample operator()(double s) const;
    // The part of the line within the sphere of radius 1 + r and the slab |z| <= r; both are too large by a few u.
    [[nodiscard]] bool clip(double& lo, double& hi) const;
    [[nodiscard]] bool one_extremum() const { return !(std::abs(cubic().turn) < 1.0); }
    // Sets `ends` to lo, the extrema of the quartic in between in increasing order, and hi.
    std::size_t extrema(double lo, double hi, std::array<double, 5>& ends) const;

   private:
    struct Cubic {
      double p, q, turn;  // s^3 + p s + q, with three real roots if |turn| < 1
    };
    [[nodiscard]] Cubic cubic() const;

    glm::dvec3 f_, e_;
    double r_;
  };

  glm::dvec3 centre_{0.0};
  AxisFrame frame_;
  double major_ = 0.0, minor_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/torus.cpp>
#endif
