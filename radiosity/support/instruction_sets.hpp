// SPDX-License-Identifier: MIT
#pragma once

// Vectors of eight doubles for the inner loops of form factors and visibility. A file of such loops (*.inc) is compiled three times: for
// the baseline of the machine, for AVX2 and for AVX-512, each function with the target attribute of its set, so that a library built
// without any machine flag uses what the machine offers. Vectors have eight lanes in all three, sums are made in one order, and nothing is
// contracted to a fused multiply-add: so results have the same bits on every machine.
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

// Of this machine; asked once.
[[nodiscard]] inline raycast::Isa instruction_set() {
  static const raycast::Isa best = raycast::best_isa();
  return best;
}

}  // namespace radiosity::detail

// The call in the namespace of the instruction set: its functions have the same names in each.
#ifdef HALFLIGHT_X86
#define HALFLIGHT_BY_SET(set, call) \
  ((set) == raycast::Isa::avx512 ? by_avx512::call : (set) == raycast::Isa::avx2 ? by_avx2::call : by_baseline::call)
#else
#define HALFLIGHT_BY_SET(set, call) (static_cast<void>(set), by_baseline::call)
#endif
