// SPDX-License-Identifier: MIT
#pragma once

// Rooms that are put together from separate polygons and sheets, as every file of another program has them: proves that no light leaves
// them. Together these must
//   - have no border: along each line as many edges run one way as the other. Corners are the same when they agree to 2^-30 of the scene;
//     an edge may meet several shorter ones (T-vertices).
//   - not pass through each other, nor through the faces of solids, by more than 1e-9 of the scene.
//   - face what they enclose: seen from each face, they wind once around what lies before it and not around what lies behind it. So a box
//     of polygons may stand in the room. Solids must stand inside.
// Then what leaves a front stays in a bounded region that shows nothing but fronts. Lamps and the like that lie on a wall and face as it
// does take no part.

#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Time: n log n for n faces, and n for each part of the scene that hangs together by its edges; of more than 1000 such parts, or so many
// edges at T-vertices, nothing is proven.
[[nodiscard]] bool enclosed_by_sheets(const std::vector<Surface>& surfaces);

// Does a flat surface lie on faces of others, which face the same way, so that its black back is never seen? They must cover it, not
// their planes alone: a lamp may lie in the plane of a wall and outside the room. Slack: 1e-9 of the scene, off the plane and as a strip
// along the borders.
[[nodiscard]] bool lies_on(const Surface& surface, const std::vector<const Surface*>& walls);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/enclosure.cpp>
#endif
