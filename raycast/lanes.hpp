// SPDX-License-Identifier: MIT
#pragma once

// What the kernels are written in.
//
// The files in kernels/ are written once, in terms of the small operations of lanes.inc, and compiled three times: portable code in vectors
// of four, AVX2 in eight, AVX-512 in sixteen, each function with the target attribute of its set, so that a library built without any
// machine flag uses what the machine offers. (A template cannot carry such an attribute as a parameter; hence the inclusion.
// HALFLIGHT_PORTABLE leaves the last two out.) The three round differently, and still answer alike: a kernel decides only what its error
// bound allows and leaves the rest to double precision.

#include <raycast/isa.hpp>

#include <cstdint>
#include <cstring>

#ifdef HALFLIGHT_X86
#include <immintrin.h>
#endif
