// SPDX-License-Identifier: MIT
// The ray caster's searches, for programs whose other files are compiled with HALFLIGHT_RAYCAST_APART (law.hpp).

#undef HALFLIGHT_RAYCAST_APART
#define HALFLIGHT_INLINE
#include "scene.hpp"
