// SPDX-License-Identifier: MIT
#pragma once

namespace apps {

// As in CMakeLists.txt; HALFLIGHT_VERSION is set there.
#ifdef HALFLIGHT_VERSION
inline constexpr const char* version = HALFLIGHT_VERSION;
#else
inline constexpr const char* version = "unknown";
#endif

}  // namespace apps
