// SPDX-License-Identifier: MIT
#pragma once

// Sums of the kernel cos cos / r^2 over all pairs of quadrature points of two patches, eight pairs at once (instruction_sets.hpp). This
// is the hottest loop of the form factors of links.

#include <cstddef>
#include <span>

#include <glm/vec3.hpp>

#include <raycast/isa.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity::detail {

// Quadrature points as structure of arrays. Beyond `count` they are padded to a multiple of eight with points of weight 0.
struct alignas(64) KernelPoints {
  static constexpr std::size_t capacity = 48;

  // Both require fits(rule). The first gives all points one normal; the second the normals of the patch's true surface.
  KernelPoints(const glm::dvec3& normal, std::span<const QuadraturePoint> rule);
  KernelPoints(const Patch& patch, std::span<const QuadraturePoint> rule);
  [[nodiscard]] static bool fits(std::span<const QuadraturePoint> rule) { return !rule.empty() && rule.size() <= capacity; }

  unsigned count = 0;
  alignas(64) double x[capacity];
  double y[capacity], z[capacity], nx[capacity], ny[capacity], nz[capacity], weight[capacity];

 private:
  template <class NormalAt>
  void set(std::span<const QuadraturePoint> rule, const NormalAt& normal_at);
};

// The light that arrives at each point from all points of the other patch, weights of both included, times pi.
struct alignas(64) KernelLight {
  double on_p[KernelPoints::capacity], on_q[KernelPoints::capacity];
  double total = 0.0;
  double square = 0.0;  // sum of the squared kernel, with the weights of both points
};

// Sum of weight * weight * cos cos / r^2. Requires that the patches lie above each other's horizon.
[[nodiscard]] double sum_of_kernel(const KernelPoints& p, const KernelPoints& q, raycast::Isa set);
// As above, by point, and also if the horizon of one patch cuts the other: pairs that face away count as 0.
void light_of_kernel(const KernelPoints& p, const KernelPoints& q, KernelLight& light, raycast::Isa set);

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/kernel_sums.cpp>
#endif
