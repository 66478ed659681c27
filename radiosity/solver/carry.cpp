// SPDX-License-Identifier: MIT

// Carries light over the links between patches, the inner loop of the linear system. For a link G (1 + g_p . x + g_q . y) from p to q:
//
//     arrived_q.value += G (sent_p.value + g_p . sent_p.slope)        arrived_q.slope += G sent_p.value g_q
//
// and likewise from q to p. With AVX2 a value and its slope are one vector of four, and so are 1 and a gradient.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/isa.hpp>

#ifdef HALFLIGHT_X86
#include <immintrin.h>
#endif

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

HALFLIGHT_INLINE void Transport::carry(const Link& link, const Moments& from, Moments& to, const glm::dvec3& gradient_from,
                                       const glm::dvec3& gradient_to) {
  const double exchange = static_cast<double>(link.exchange);
  to.value += exchange * (from.value + glm::dot(gradient_from, from.slope));
  to.slope += exchange * from.value * gradient_to;
}

#ifdef HALFLIGHT_X86
namespace detail {

// (1, gradient) of a shape, which is in the last 6 of these 8 bytes of a link.
[[nodiscard]] __attribute__((target("avx2"), always_inline)) inline __m256d one_and_gradient(const char* bytes) {
  constexpr std::uint64_t one = 0x3f80;  // 1.0 as the upper half of a float
  std::uint64_t halves;
  std::memcpy(&halves, bytes, sizeof(halves));
  const __m128i words = _mm_cvtepu16_epi32(_mm_cvtsi64_si128(static_cast<long long>((halves & ~std::uint64_t{0xffff}) | one)));
  return _mm256_cvtps_pd(_mm_castsi128_ps(_mm_slli_epi32(words, 16)));
}

// The same as Transport::carry(link, from, to, ...), with the same rounding.
__attribute__((target("avx2"), always_inline)) inline void carry_one_way(double exchange, __m256d from, double* to, __m256d gradient_from,
                                                                         __m256d gradient_to) {
  const __m256d product = _mm256_mul_pd(from, gradient_from);
  const __m128d low = _mm256_castpd256_pd128(product), high = _mm256_extractf128_pd(product, 1);
  const double value = _mm_cvtsd_f64(low);
  const double sum =
      value + ((_mm_cvtsd_f64(_mm_unpackhi_pd(low, low)) + _mm_cvtsd_f64(high)) + _mm_cvtsd_f64(_mm_unpackhi_pd(high, high)));
  const __m256d slope = _mm256_mul_pd(_mm256_set1_pd(exchange * value), gradient_to);
  const __m256d more = _mm256_blend_pd(slope, _mm256_castpd128_pd256(_mm_set_sd(exchange * sum)), 1);
  _mm256_storeu_pd(to, _mm256_add_pd(_mm256_loadu_pd(to), more));
}

// Is the link without a gradient? Most are, because most links are between leaves.
[[nodiscard]] inline bool is_even(const Link& link) {
  std::uint32_t words[3];
  static_assert(sizeof(words) == sizeof(link.shape_p) + sizeof(link.shape_q));
  std::memcpy(words, reinterpret_cast<const char*>(&link) + offsetof(Link, shape_p), sizeof(words));
  return (words[0] | words[1] | words[2]) == 0;
}

__attribute__((target("avx2"))) inline void carry_both_ways(std::span<const Link> links, const double* sent, double* arrived) {
  static_assert(offsetof(Link, shape_p) == 12 && offsetof(Link, shape_q) == 18);
  for (const Link& link : links) {
    const auto exchange = static_cast<double>(link.exchange);
    const std::size_t at_p = 4 * std::size_t{link.p}, at_q = 4 * std::size_t{link.q};
    if (is_even(link)) {
      arrived[at_q] += exchange * sent[at_p];
      arrived[at_p] += exchange * sent[at_q];
      continue;
    }
    const char* const bytes = reinterpret_cast<const char*>(&link);
    const __m256d p = one_and_gradient(bytes + offsetof(Link, shape_p) - 2), q = one_and_gradient(bytes + offsetof(Link, shape_q) - 2);
    carry_one_way(exchange, _mm256_loadu_pd(sent + at_p), arrived + at_q, p, q);
    carry_one_way(exchange, _mm256_loadu_pd(sent + at_q), arrived + at_p, q, p);
  }
}

}  // namespace detail
#endif

HALFLIGHT_INLINE void Transport::carry(std::span<const Link> links, const std::vector<Moments>& sent, std::vector<Moments>& arrived,
                                       [[maybe_unused]] raycast::Isa set) {
#ifdef HALFLIGHT_X86
  static_assert(sizeof(Moments) == 4 * sizeof(double) && offsetof(Moments, slope) == sizeof(double));
  if (set != raycast::Isa::portable) {
    detail::carry_both_ways(links, &sent.data()->value, &arrived.data()->value);
    return;
  }
#endif
  for (const Link& link : links) {
    carry(link, sent[link.p], arrived[link.q], link.shape_p.gradient(), link.shape_q.gradient());
    carry(link, sent[link.q], arrived[link.p], link.shape_q.gradient(), link.shape_p.gradient());
  }
}

}  // namespace radiosity
