// SPDX-License-Identifier: MIT
#pragma once

// A header declares (in brep/ only in csg/: the rest are templates); the source of the same name (.cpp) defines, and is compiled once into
// the library. In a program that is compiled with HALFLIGHT_HEADER_ONLY each header includes its source, and all definitions are inline
// functions.

#ifdef HALFLIGHT_HEADER_ONLY
#define HALFLIGHT_INLINE inline
#else
#define HALFLIGHT_INLINE
#endif
