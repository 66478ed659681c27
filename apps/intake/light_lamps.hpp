// SPDX-License-Identifier: MIT
#pragma once

// Lamps for the lights of a file, which have no surface: a light that shines from a point becomes a small ball, a spot a ball in a
// black cup, a directional light a far sun.

#include <vector>

#include "apps/intake/model.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Adds an object for each light, in the coordinates of the scene, and says so in the notes and warnings.
//
// Ball: its radius is at most 2 cm, a hundredth of the scene's diameter, and a tenth of the way to the next surface. One of I W/sr has the
// exitance I / radius^2.
// Spot: a ball in a black cup (spot_cup.hpp), neither of them larger than twice the radius of a ball without one.
// Sun: a disk half a degree wide, a thousand diameters of the scene away, so that its rays are parallel within a sixteenth of that. At ten
// thousand, rooms lit through windows took 15 to 40 % longer.
//
// A relative intensity of 1 gives 100 W/m2 at half the scene's size, and everywhere if it is a sun's.
void add_light_lamps(SceneFile& file, const std::vector<ModelLight>& lights);

}  // namespace apps
