// SPDX-License-Identifier: MIT
#pragma once

// Which vector instructions this machine has, and the kernels compiled for each of them.
//
// The files in kernels/ are written once, in terms of the small operations of lanes.inc, and compiled three times: portable code in vectors of
// four, AVX2 in eight, AVX-512 in sixteen, each function with the target attribute of its set, so that a library built without any
// machine flag uses what the machine offers. (A template cannot carry such an attribute as a parameter; hence the inclusion.
// HALFLIGHT_PORTABLE leaves the last two out.) The three round differently, and still answer alike: a kernel decides only what its error
// bound allows and leaves the rest to double precision.

#include <cstdint>
#include <cstring>

#if (defined(__x86_64__) || defined(_M_X64)) && defined(__GNUC__) && !defined(HALFLIGHT_PORTABLE)
#define HALFLIGHT_X86 1
#include <immintrin.h>
#endif

namespace raycast {

enum class Isa : std::uint8_t { portable, avx2, avx512 };

// The best set of this machine.
[[nodiscard]] inline Isa best_isa() {
#ifdef HALFLIGHT_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma"))
    return Isa::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::avx2;
#endif
  return Isa::portable;
}

}  // namespace raycast
