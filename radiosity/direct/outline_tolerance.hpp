// SPDX-License-Identifier: MIT
#pragma once

// How finely a solid must be approximated so that its outline is accurate. Where two sheets meet at an angle, as at the rim of a lens,
// the outline follows the curve between them.

#include <cstdint>

#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

// The tolerance (a length) of an approximation of the solid whose outline is off by at most `part` of the solid's size. Chords that are
// off both surfaces by d are off their common curve by d / sin(half the dihedral angle). So the tolerance is that of a smooth solid,
// reduced by this factor where the angle is below 90 degrees, but at most to an eighth. The size is measured on a coarse approximation,
// because the bounds may be much wider.
[[nodiscard]] double outline_tolerance(const raycast::PlacedObject& object, double part);

// The facets of a sheet of a curved solid. Begins with the tolerance above and makes it smaller until the facets have the area of the
// sheet within .3 %, or would be more than 4096. A tolerance relative to its length leaves a long tube or a thin ring only eight facets
// around, and the width of its outline then varies by 8 % with the direction. (n chords of a circle lose (pi / n)^2 / 6 of its length, and
// up to three times that of its width.)
[[nodiscard]] Facets facets_for_outline(const raycast::PlacedObject& object, double part, std::uint32_t sheet);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/outline_tolerance.cpp>
#endif
