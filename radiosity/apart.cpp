// SPDX-License-Identifier: MIT
// The solver, for programs whose other files are compiled with HALFLIGHT_RADIOSITY_APART (run.hpp).

#undef HALFLIGHT_RADIOSITY_APART
#define HALFLIGHT_RADIOSITY_INLINE
#include <radiosity/radiosity.hpp>
