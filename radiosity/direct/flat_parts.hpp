// SPDX-License-Identifier: MIT
#pragma once

// Faces of the approximation of a curved object (raycast::Object::approximate) in parts that are planar. Those of its flat sheets are so
// already; others are warped, and along a curve in which two surfaces meet they have any number of corners and need not be convex.

#include <cstdint>
#include <vector>

#include <brep/builder_input.hpp>

namespace radiosity {

// Corners of a face, as vertices of the boundary, or of a part of it, in the same order.
using FaceCorners = std::vector<std::uint32_t>;

// Appends the face, of three corners at least, to `parts`: as it is when it is planar, else in triangles, cut by its best inner diagonals
// (brep/outline.hpp). Faces of four corners are always cut: on a curved surface some are planar by chance alone. Cost: O(n^4) for n corners
// that are in no plane; there are rarely more than ten.
void append_flat_parts(const brep::Builder& boundary, const FaceCorners& face, std::vector<FaceCorners>& parts);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/flat_parts.cpp>
#endif
