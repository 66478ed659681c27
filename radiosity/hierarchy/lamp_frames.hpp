// SPDX-License-Identifier: MIT
#pragma once

// Frames around lamps that stand on a face, such as the boards around the panels of an office, which touch the ceiling. Inside a frame
// the face is far brighter or far darker than outside: bright where a lamp shines at it, dark behind a lamp's back. A patch across the
// foot of the frame would carry light through it. So a face is cut along frames even if these are short beside it, and however many
// walls stand on it (wall_cuts.hpp).
//
// Every cut divides the whole part, so its order matters: a cut that first separates one lamp from the others is longer covered by its
// frame and divides no other frame.

#include <cstddef>
#include <vector>

#include <brep/handles.hpp>
#include <brep/split_objects.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_lines.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// Largest number of cuts along frames that are made on one face.
inline constexpr std::size_t most_frame_cuts = 1024;

// The bounds of all faces that emit.
class LampBoxes {
 public:
  // `emission`: of each input surface; none if empty.
  LampBoxes(const std::vector<Surface>& surfaces, const std::vector<Color>& emission);
  // The bounds of the lamps around which this wall may be a frame: they are near, and not much smaller than the wall. None if they are more
  // than 64, because then the wall is one among many things that shine, not a frame. Time: log n for n faces that emit, if none is much
  // larger than most.
  [[nodiscard]] std::vector<raycast::Box> beside(const WallFace& wall) const;

 private:
  std::vector<raycast::Box> boxes_;
  raycast::Bvh tree_;
  double largest_ = 0.0;  // diameter of the largest box
};

// The best cut of this part along a line beside a lamp; not valid if there is none that is worthwhile. Time: linear in the number of
// lines, times at most 64.
[[nodiscard]] brep::Cut cut_at_frame(const SurfaceBRep& brep, brep::FaceId part, const std::vector<WallLine>& lines);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/lamp_frames.cpp>
#endif
