// SPDX-License-Identifier: MIT
#pragma once

// Cuts along a plane: the split object AlongPlane and the condition object BesidePlane.
//
// The plane meets the boundary of a face in corners that lie on it and in points inside edges whose ends lie on different sides. In their
// order along the common line, a cut runs from a point where the inside of the face begins to the next one where it
// ends. A corner counts as on the plane up to 1e-12 times the extent of the face plus the rounding of the coordinates (16 ulp).
// That is decided at each point from its own two edges, so it is right for faces whose holes are reached by bridge edges, where
// two half-edges pass each point of the bridge.
//
// A part that lies on one side has no place for a further cut. A face of n edges meets the plane in at most n points, so at
// most n / 2 cuts and n new vertices are made, whatever the condition is.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/geometry.hpp>
#include <brep/small_list.hpp>
#include <brep/split_objects.hpp>

namespace brep {

// Split object. The normal need not have length one; with a normal of no length, or not finite, no place is found.
struct AlongPlane {
  glm::dvec3 point{0.0}, normal{0.0};

  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const auto points = positions(brep, f);
    const std::size_t count = points.size();
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length)) { return {}; }
    const glm::dvec3 unit = normal / length;
    double far = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    for (const glm::dvec3& p : points) { far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }
    const double tolerance = 1e-12 * extent(points) + 16.0 * std::numeric_limits<double>::epsilon() * far;

    SmallList<glm::dvec2> flat;  // x along the common line, y the height above the plane: 0 when on it
    const glm::dvec3 along = glm::cross(unit, brep::normal(points));
    const double scale = glm::length(along) > 0.0 ? 1.0 / glm::length(along) : 0.0;
    bool above = false, below = false;
    for (const glm::dvec3& p : points) {
      const double y = glm::dot(p - point, unit);
      flat.push_back({scale * glm::dot(p - points[0], along), std::abs(y) > tolerance ? y : 0.0});
      above = above || y > tolerance;
      below = below || y < -tolerance;
    }
    if (!above || !below) { return {}; }

    SmallList<Crossing> crossings;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec2 here = flat[i], after = flat[(i + 1) % count];
      if (here.y == 0.0) {
        const glm::dvec2 in = flat[(i + count - 1) % count] - here, out = after - here;
        crossings.push_back({here.x, i, 0.0, inside(in, out, 1.0), inside(in, out, -1.0)});
      } else if (here.y * after.y < 0.0) {
        const double t = here.y / (here.y - after.y);
        crossings.push_back({here.x + t * (after.x - here.x), i, t, here.y > 0.0, here.y < 0.0});
      }
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const Crossing& from = crossings[i];
      if (!from.begins) { continue; }
      std::size_t k = i + 1;
      while (k < crossings.size() && crossings[k].x <= from.x + tolerance) { ++k; }
      for (const double near = k < crossings.size() ? crossings[k].x + tolerance : 0.0; k < crossings.size() && crossings[k].x <= near;
           ++k) {
        if (!crossings[k].ends) { continue; }
        const auto loop = detail::loop_of(brep, f);
        return {loop[from.corner], loop[crossings[k].corner], from.fraction, crossings[k].fraction};
      }
    }
    return {};
  }

 private:
  struct Crossing {
    double x;
    std::size_t corner;  // the half-edge that starts there or is crossed
    double fraction;
    bool begins, ends;  // the inside of the face lies behind, before the point
  };

  // Does the direction (x, 0) point strictly into the face at a corner, seen from which `in` and `out` are the two neighbours?
  static bool inside(const glm::dvec2& in, const glm::dvec2& out, double x) {
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 d{x, 0.0};
    const double turn = cross(out, in);  // positive: the angle of the face is below pi
    const bool straight = turn == 0.0 && glm::dot(in, out) < 0.0;
    if (turn > 0.0 || straight) { return cross(out, d) > 0.0 && cross(d, in) > 0.0; }
    const double after_in = cross(in, d), before_out = cross(d, out);  // is it in the angle outside, its sides included?
    return after_in < 0.0 || before_out < 0.0 || (after_in == 0.0 && before_out == 0.0 && glm::dot(d, in) < 0.0);
  }
};

// Condition object: AlongPlane finds no place, the face lies on one side of the plane.
struct BesidePlane {
  using condition_object = BesidePlane;
  glm::dvec3 point{0.0}, normal{0.0};
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return !AlongPlane{point, normal}(brep, f).a.valid();
  }
};

}  // namespace brep
