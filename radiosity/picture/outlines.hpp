// SPDX-License-Identifier: MIT
#pragma once

// What the picture of a mesh has wrong at the outlines of curved objects, where facets show something else than the true surface: what lies
// behind it, or the sheet beside. Two kinds of edges make outlines:
//
//   within a sheet      one of the two faces is seen from its front, the other from its back. The true outline lies beyond the edge by as
//                       much as the surface between the middles of the two faces stands out at most.
//   between two sheets  a rim, such as that of a cylinder's cap: it lies where both sheets meet, the edge is its chord.
//
// The area between the edge and the true outline, as the camera sees it, is wrong by the contrast of what is seen on both sides of the
// outline. The pixels of a picture are means: a strip that is narrower than a pixel counts by its width once more (Viewpoint::pixel).
// Where a lamp is seen on either side nothing is counted, as by the audit of pictures (audit/picture_error.hpp).

#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// Of each surface, by the index of the face: the integral of the squared error over the picture, in the unit of MeshErrorMeter::square().
// What is wrong at an edge counts half for either of its faces. `surfaces` may have T-vertices.
[[nodiscard]] std::vector<std::vector<double>> outline_errors(const FinalGather& light, const std::vector<Surface>& surfaces,
                                                              const Viewpoint& from, unsigned threads);

// The mean square of a strip over the pixels it falls on, when it may lie anywhere: times the length of a pixel, for a strip of this width,
// in pixels, and unit length.
[[nodiscard]] inline double strip_in_pixels(double width) { return width < 1.0 ? width * width * (1.0 - width / 3.0) : width - 1.0 / 3.0; }

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/outlines.cpp>
#endif
