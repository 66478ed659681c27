// SPDX-License-Identifier: MIT
#pragma once

// Determines which side of a surface is lit. The inside of a solid is dark, whatever the orientation of its faces, so the side that light
// reaches was meant to be visible. This is a coarse radiosity solution of the polygons themselves, before they become objects: every
// piece of surface reflects on both sides, links are rays, lamps emit, eyes are small lamps, and a little light comes from outside.
// Cracks let some light into a solid, but so much less than falls on its outside that the ratio of both decides.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>
#include <raycast/planar.hpp>

#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// One side of a piece; means over its area.
struct SideView {
  double light = 0.0;              // irradiance, relative to the exitance of a lamp
  double way = 0.0;                // straight distance to the next surface, or twice the size of the model where there is none
  double met = 0.0, to_met = 0.0;  // share of the directions in which there is a surface, and the sum of distances over these
};

struct PieceView {
  SideView front, back;
  double covered = 0.0;  // share of its area on which other faces lie
};

class SideLight {
 public:
  // `piece`: by face, a number below `pieces`. The mesh must not change during the lifetime of this.
  SideLight(Working& mesh, std::span<const std::uint32_t> piece, std::uint32_t pieces);

  // The views of each piece; deterministic. Time: some microseconds for each of half a million rays, or of eight rays a face if that is
  // more.
  [[nodiscard]] std::vector<PieceView> solve(std::span<const Material> materials, std::span<const glm::dvec3> eyes);

 private:
  // A point on a side of a face, from which rays start. Light is stored at points, not at faces, because a large face may be lit in one
  // part and covered by an object in another.
  struct Point {
    glm::dvec3 position{0.0};
    std::uint32_t side = 0;  // twice the index of the face, plus 1 for its back
    double area = 0.0;       // area that it represents
    double light = 0.0, before = 0.0;
  };
  struct Met {
    std::uint32_t side = none;    // side of a face; none: nothing was hit
    std::uint32_t beside = none;  // side of a face that coincides with it there
    double way = 0.0;             // distance
  };
  struct RayEnd {
    std::uint32_t point = none, beside = none;  // nearest points on the sides of Met
    std::uint32_t as_lit = none;                // point whose light the hit surface reflects
  };

  // The first hit of a ray in this unit direction; `source`: the face where it starts, or none.
  [[nodiscard]] Met first_met(const glm::dvec3& from, const glm::dvec3& direction, std::uint32_t source) const;
  [[nodiscard]] glm::dvec3 point_of(std::uint32_t face, double u, double v) const;
  // The point on this side of a face that is nearest to the place.
  [[nodiscard]] std::uint32_t nearest_point(std::uint32_t side, const glm::dvec3& place) const;
  // Does something stand between the place, which a ray of length `way` has hit, and the point nearest to it, so that the light of the
  // point does not apply? Example: the floor inside a table leg without a bottom, and the floor around it.
  [[nodiscard]] bool cut_off(const glm::dvec3& place, const Point& point, double way) const;
  void place_points();
  void shoot();
  void set_lamps(std::span<const Material> materials);
  void set_eyes(std::span<const glm::dvec3> eyes);
  [[nodiscard]] double light_along(const RayEnd& end) const;
  void bounce();

  Working& mesh_;
  std::span<const std::uint32_t> piece_;
  double size_ = 0.0;  // size of the whole model
  raycast::Bvh bvh_;
  std::vector<std::vector<glm::dvec3>> outline_;  // by face
  std::vector<raycast::Plane> plane_;
  std::vector<double> area_;  // by face
  std::vector<Point> points_;
  std::vector<std::uint32_t> first_point_;  // by side of a face, and one entry more
  std::uint32_t rays_ = 0;                  // per point
  std::vector<RayEnd> met_;                 // by ray
  std::vector<double> sent_;                // by side of a face: emitted light, relative to a lamp
  std::vector<PieceView> views_;
  double outside_ = 0.0;  // radiance of rays that hit nothing
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/side_light.cpp>
#endif
