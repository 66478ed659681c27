// SPDX-License-Identifier: MIT
#pragma once

// The lines across a flat face on which walls stand, or over which the outline of an object close in front of the face lies
// (wall_cuts.hpp).

#include <array>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/split_objects.hpp>

#include <raycast/box.hpp>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// Objects thicker than this share of their length count as blocks, not walls: cutting along a block makes long narrow patches, which do
// more harm than good.
inline constexpr double thickness_of_wall = 0.2;
// A wall whose foot is nearer to a face than this share of its height above the face stands on it: files of other programs have feet that
// are rounded, or a millimetre above or below the floor, and a patch that extends under such a wall would be no better than under one
// that touches.
inline constexpr double foot_gap = 0.005;
// An object parallel to a face hides it if its distance is at most this share of its own diameter.
inline constexpr double close_gap = 0.02;

struct WallFace {
  Polygon polygon;
  glm::dvec3 normal{0.0};
  raycast::Box box;
  double thickness = 0.0;           // distance from this face to the one on the other side of the wall; 0 for a sheet
  std::vector<raycast::Box> lamps;  // those beside it (lamp_frames.hpp)
};

// A line across a face, and the intervals of it on which walls stand.
struct WallLine {
  glm::dvec3 point{0.0}, normal{0.0};  // point and normal of the walls' plane
  glm::dvec3 along{0.0};               // unit
  std::vector<std::pair<double, double>> intervals;
  bool thin = true;          // are all walls on it thin?
  double hidden = 0.0;       // area of the object close to the face whose outline this line is; 0 for walls
  bool beside_lamp = false;  // is one of the walls part of a frame around a lamp?

  [[nodiscard]] double at(const glm::dvec3& p) const { return glm::dot(p - point, along); }
  // Where a cut of a face begins and ends on the line.
  [[nodiscard]] std::array<double, 2> ends(const SurfaceBRep& brep, const brep::Cut& cut) const;
  // Sorts the intervals and joins those that overlap, or are closer to each other than `tolerance`.
  void join_intervals(double tolerance);
  // Length of the part between two places that the walls cover, once intervals are joined.
  [[nodiscard]] double covered(double from, double to) const;
};

// The faces of an object that may stand on others.
[[nodiscard]] std::vector<WallFace> wall_faces(const Surface& surface);

// Adds the interval on which `wall` stands on the plane of `face` or passes through it, if it rises above the front of the face.
void add_wall(const WallFace& face, const WallFace& wall, double tolerance, std::vector<WallLine>& lines);

// Adds the outline of `sheet` if it is parallel to `face` and close in front of it, as a lamp under a ceiling: the face is dark behind it
// and bright beside it.
void add_outline(const WallFace& face, const WallFace& sheet, double tolerance, std::vector<WallLine>& lines);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/wall_lines.cpp>
#endif
