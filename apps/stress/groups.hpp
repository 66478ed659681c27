// SPDX-License-Identifier: MIT
#pragma once

// The cases by what is stiff or extreme in them.

#include "apps/stress/case.hpp"

namespace apps::stress {

[[nodiscard]] std::vector<Case> light_cases();     // reflectance, emission, the linear system
[[nodiscard]] std::vector<Case> contact_cases();   // what touches, coincides, overlaps
[[nodiscard]] std::vector<Case> boundary_cases();  // shells, normals, what hides what
[[nodiscard]] std::vector<Case> size_cases();      // scale, place, thinness, number and depth

}  // namespace apps::stress
