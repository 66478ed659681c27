// SPDX-License-Identifier: MIT
#pragma once

// Proves that no light leaves rooms put together from separate polygons and sheets, as in files of other programs. Together these must
//   - have no border: along each line as many edges run one way as the other. Corners are equal if they agree to 2^-30 of the scene; an
//     edge may meet several shorter ones (T-vertices).
//   - not intersect each other, nor the faces of solids, by more than 1e-9 of the scene.
//   - face what they enclose: their winding number is 1 in front of each face and 0 behind it. So a box of polygons may stand in the
//     room. Solids must stand inside.
// Then light leaving a front stays in a bounded region in which only fronts are visible. Surfaces that lie on a wall and face the same way,
// such as lamps, are ignored.

#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Time: n log n for n faces, and n for each part of the scene connected by edges. With more than 1000 such parts, or as many edges at
// T-vertices, nothing is proven.
[[nodiscard]] bool enclosed_by_sheets(const std::vector<Surface>& surfaces);

// Does a flat surface lie on faces of others that face the same way, so that its black back is never seen? The faces must cover it, not
// only lie in the same plane, because a lamp may lie in the plane of a wall outside the room. Slack: 1e-9 of the scene, off the plane and
// in a strip along the borders.
[[nodiscard]] bool lies_on(const Surface& surface, const std::vector<const Surface*>& walls);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/enclosure.cpp>
#endif
