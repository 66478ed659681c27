// SPDX-License-Identifier: MIT
#pragma once

// The error of a mesh picture at the outlines of curved objects, where facets hide or show something else than the true surface does:
// what lies behind it, or the adjacent sheet. Two kinds of edges form outlines:
//
//   within a sheet      one of the two faces is seen from its front, the other from its back. The distance of the true outline from the
//                       edge is the largest height of the surface above the edge, measured between the centres of the two faces.
//   between two sheets  a rim, such as that of a cylinder's cap: the true outline is the curve of both sheets, the edge is its chord.
//
// The error is the area between edge and true outline, as the camera sees it, times the squared contrast between both sides. Pixels are
// means over their area, so a strip narrower than a pixel is weighted with its width in pixels once more (Viewpoint::pixel). Where a lamp
// is seen on either side nothing is counted, as in the audit of pictures (audit/picture_error.hpp).

#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// By surface and index of the face: the squared error integrated over the picture, in the unit of MeshErrorMeter::square(). The error at
// an edge is divided equally between its faces. `surfaces` may have T-vertices.
[[nodiscard]] std::vector<std::vector<double>> outline_errors(const FinalGather& light, const std::vector<Surface>& surfaces,
                                                              const Viewpoint& from, unsigned threads);

// Integral of the squared pixel values over the pixels that a strip of value 1 covers, per unit length, averaged over all positions of
// the strip; `width` in pixels.
[[nodiscard]] inline double strip_in_pixels(double width) { return width < 1.0 ? width * width * (1.0 - width / 3.0) : width - 1.0 / 3.0; }

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/outlines.cpp>
#endif
