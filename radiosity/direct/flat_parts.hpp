// SPDX-License-Identifier: MIT
#pragma once

// Splits faces of a curved object's polygonal approximation (raycast::Object::approximate) into planar parts. Faces of flat sheets are
// planar already. Other faces are warped; along a curve in which two surfaces meet they have any number of corners and need not be convex.

#include <cstdint>
#include <vector>

#include <brep/builder_input.hpp>

namespace radiosity {

// Corners of a face or of a part of it, as vertices of the boundary, in contour order.
using FaceCorners = std::vector<std::uint32_t>;

// Appends the face, which has at least three corners, to `parts`: unchanged if it is planar, otherwise cut into triangles by its best
// inner diagonals (brep/outline.hpp). Faces of four corners are always cut, because on a curved surface some are planar by chance only.
// Cost: O(n^4) for n corners that are not coplanar; n is rarely above ten.
void append_flat_parts(const brep::Builder& boundary, const FaceCorners& face, std::vector<FaceCorners>& parts);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/flat_parts.cpp>
#endif
