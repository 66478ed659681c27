// SPDX-License-Identifier: MIT
#pragma once

// Which side of a surface is in the light? The inside of a solid is dark, whichever way its faces were wound: so the side that light
// reaches is the one that was meant to be seen. This is a coarse radiosity of the polygons themselves, before they are objects: every
// piece of surface has two sides that both reflect, links are rays, lamps shine, eyes are small lamps, and a little light comes from
// outside. Cracks let some light into a solid, but so much less than falls on its outside that the ratio tells.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>
#include <raycast/planar.hpp>

#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// Of a side of a piece, as means over its area.
struct SideView {
  double light = 0.0;  // that falls on it, relative to what a lamp sends out
  double way = 0.0;    // length of the straight way from it to the next surface
};

struct PieceView {
  SideView front, back;
  double covered = 0.0;  // the part of its area on which other faces lie
};

class SideLight {
 public:
  // `piece`: of each face a number below `pieces`. The mesh must stay as it is while this lives.
  SideLight(Working& mesh, std::span<const std::uint32_t> piece, std::uint32_t pieces);

  // Of each piece. The same numbers in every run. Some microseconds for each of half a million rays, or of eight for each face where that
  // is more.
  [[nodiscard]] std::vector<PieceView> solve(std::span<const Material> materials, std::span<const glm::dvec3> eyes);

 private:
  // A point on a side of a face, from which rays start. Light is known at points, not on faces: of a large face a part may be lit, and
  // another part be covered by what stands on it.
  struct Point {
    glm::dvec3 position{0.0};
    std::uint32_t side = 0;  // twice the face, one more for its back
    double area = 0.0;       // that it stands for
    double light = 0.0, before = 0.0;
  };
  struct Met {
    std::uint32_t side = none;    // of a face; none: nothing
    std::uint32_t beside = none;  // of a face that coincides with it there
    double way = 0.0;             // how far it was
  };
  struct RayEnd {
    std::uint32_t point = none, beside = none;  // as in Met
    std::uint32_t as_lit = none;                // what it meets reflects as much light as there is at this point
  };

  // What a ray of this unit direction meets; it comes from the face `source`, or from none.
  [[nodiscard]] Met first_met(const glm::dvec3& from, const glm::dvec3& direction, std::uint32_t source) const;
  [[nodiscard]] glm::dvec3 point_of(std::uint32_t face, double u, double v) const;
  // The point nearest to this place on a side of a face.
  [[nodiscard]] std::uint32_t nearest_point(std::uint32_t side, const glm::dvec3& place) const;
  // Does something stand between this place on a side of a face, which a ray of this length met, and the point nearest to it, so that the
  // light there tells nothing? As between the floor in a leg without a bottom and the floor around it.
  [[nodiscard]] bool cut_off(const glm::dvec3& place, const Point& point, double way) const;
  void place_points();
  void shoot();
  void set_lamps(std::span<const Material> materials);
  void set_eyes(std::span<const glm::dvec3> eyes);
  [[nodiscard]] double light_along(const RayEnd& end) const;
  void bounce();

  Working& mesh_;
  std::span<const std::uint32_t> piece_;
  double size_ = 0.0;  // of everything
  raycast::Bvh bvh_;
  std::vector<std::vector<glm::dvec3>> outline_;  // of a face
  std::vector<raycast::Plane> plane_;
  std::vector<double> area_;  // of a face
  std::vector<Point> points_;
  std::vector<std::uint32_t> first_point_;  // of a side of a face, and one more
  std::uint32_t rays_ = 0;                  // of a point
  std::vector<RayEnd> met_;                 // of a ray
  std::vector<double> sent_;                // of a side of a face: what a lamp sends
  std::vector<PieceView> views_;
  double outside_ = 0.0;  // light from where nothing is
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/side_light.cpp>
#endif
