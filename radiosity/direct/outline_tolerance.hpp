// SPDX-License-Identifier: MIT
#pragma once

// How finely a solid must be approximated for its outline. Where two sheets meet at an angle, as at the rim of a lens, the outline runs
// along the curve between them.

#include <raycast/transform.hpp>

namespace radiosity {

// The tolerance (a length) of the approximation of a solid by which such curves are off by `part` of its size. Chords that are off both
// surfaces by d are off their curve by d / sin of half the angle of the solid there; a right angle counts as none, and below an eighth of
// that of other solids the tolerance does not fall. Its size is that of a coarse approximation: bounds may be far wider.
[[nodiscard]] double outline_tolerance(const raycast::PlacedObject& object, double part);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/outline_tolerance.cpp>
#endif
