// SPDX-License-Identifier: MIT
#pragma once

// Vectors of eight doubles for the inner loops of form factors and visibility. A file with such loops (*.inc) is compiled three times,
// for the baseline of the machine, for AVX2 and for AVX-512, each function with the target attribute of its set; so a library built
// without machine flags uses what the machine offers. Vectors have eight lanes in all three, sums have a fixed order, and nothing is
// contracted to a fused multiply-add, so results have the same bits on every machine.
//
//     #define HALFLIGHT_WIDE_FILE <radiosity/exchange/kernel_sums.inc>
//     #include <radiosity/support/for_each_set.inc>
//     ...
//     HALFLIGHT_BY_SET(instruction_set(), sum_of_kernel(p, q))

#include <cstdint>

#include <raycast/isa.hpp>

namespace radiosity::detail {

using Wide = double __attribute__((vector_size(64)));
using WideBits = std::uint64_t __attribute__((vector_size(64)));
using WideIntegers = std::int64_t __attribute__((vector_size(64)));
inline constexpr unsigned wide_lanes = 8;

// The best set of this machine; determined once.
[[nodiscard]] inline raycast::Isa instruction_set() {
  static const raycast::Isa best = raycast::best_isa();
  return best;
}

}  // namespace radiosity::detail

// Calls the function of this name in the namespace of the instruction set.
#ifdef HALFLIGHT_X86
#define HALFLIGHT_BY_SET(set, call) \
  ((set) == raycast::Isa::avx512 ? by_avx512::call : (set) == raycast::Isa::avx2 ? by_avx2::call : by_baseline::call)
#else
#define HALFLIGHT_BY_SET(set, call) (static_cast<void>(set), by_baseline::call)
#endif
