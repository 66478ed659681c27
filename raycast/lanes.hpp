// SPDX-License-Identifier: MIT
#pragma once

// How the kernels are compiled for several instruction sets.
//
// The files in kernels/ are written once, in terms of the small operations of lanes.inc, and compiled three times: portable code with
// vectors of four, AVX2 with eight, AVX-512 with sixteen, each function with the target attribute of its set, so that a library built
// without machine flags uses what the machine offers. (A template cannot take such an attribute as a parameter, hence the inclusion.
// HALFLIGHT_PORTABLE leaves the last two out.) The three round differently but give the same answers, because a kernel decides only what
// its error bound allows and leaves the rest to double precision.

#include <raycast/isa.hpp>

#include <cstdint>
#include <cstring>

#ifdef HALFLIGHT_X86
#include <immintrin.h>
#endif
