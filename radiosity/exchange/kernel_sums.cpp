// SPDX-License-Identifier: MIT
#include <radiosity/exchange/kernel_sums.hpp>

#include <span>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/isa.hpp>

#include <radiosity/hierarchy/bend.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/instruction_sets.hpp>

#define HALFLIGHT_WIDE_FILE <radiosity/exchange/kernel_sums.inc>
#include <radiosity/support/for_each_set.inc>

namespace radiosity::detail {

template <class NormalAt>
void KernelPoints::set(std::span<const QuadraturePoint> rule, const NormalAt& normal_at) {
  count = static_cast<unsigned>(rule.size());
  for (unsigned i = 0; i < count || i % wide_lanes != 0; ++i) {
    const QuadraturePoint& point = rule[i < count ? i : 0];
    const glm::dvec3 normal = normal_at(point.position);
    x[i] = point.position.x, y[i] = point.position.y, z[i] = point.position.z;
    nx[i] = normal.x, ny[i] = normal.y, nz[i] = normal.z;
    weight[i] = i < count ? point.weight : 0.0;
  }
}

HALFLIGHT_INLINE KernelPoints::KernelPoints(const glm::dvec3& normal, std::span<const QuadraturePoint> rule) {
  set(rule, [&](const glm::dvec3&) { return normal; });
}
HALFLIGHT_INLINE KernelPoints::KernelPoints(const Patch& patch, std::span<const QuadraturePoint> rule) {
  set(rule, [&](const glm::dvec3& at) { return normal_over(patch, at); });
}

HALFLIGHT_INLINE double sum_of_kernel(const KernelPoints& p, const KernelPoints& q, [[maybe_unused]] raycast::Isa set) {
  return HALFLIGHT_BY_SET(set, sum_of_kernel(p, q));
}

HALFLIGHT_INLINE void light_of_kernel(const KernelPoints& p, const KernelPoints& q, KernelLight& light, [[maybe_unused]] raycast::Isa set) {
  HALFLIGHT_BY_SET(set, light_of_kernel(p, q, light));
}

}  // namespace radiosity::detail
