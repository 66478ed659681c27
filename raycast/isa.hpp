// SPDX-License-Identifier: MIT
#pragma once

// The vector instruction sets with which a scene can be searched (lanes.hpp).

#include <cstdint>

#if (defined(__x86_64__) || defined(_M_X64)) && defined(__GNUC__) && !defined(HALFLIGHT_PORTABLE)
#define HALFLIGHT_X86 1
#endif

namespace raycast {

enum class Isa : std::uint8_t { portable, avx2, avx512 };

// The best instruction set of this machine.
[[nodiscard]] inline Isa best_isa() {
#ifdef HALFLIGHT_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma")) {
    return Isa::avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) { return Isa::avx2; }
#endif
  return Isa::portable;
}

}  // namespace raycast
