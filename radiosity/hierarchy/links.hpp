// SPDX-License-Identifier: MIT
#pragma once

// A link carries light between two nodes at any level of the hierarchy. It is stored once for an unordered pair and used in both
// directions: each end sends to the other one and receives from it. So reciprocity holds exactly and the operator of the linear system is
// symmetric.
//
// Between a point x of the patch p and a point y of the patch q, the link represents the kernel
//
//     K(x, y) = G / (A_p A_q) * (1 + g_p . (x - c_p) + g_q . (y - c_q))
//
// with G = A_p F_pq = A_q F_qp (visibility included) and c the centroids. The constant term is the paper's link. The gradients g describe
// how the light varies across a large patch. Without them a leaf in the corner of a room inherits, from each level above, the mean over a
// patch that reaches far out of the corner, and its row sum is wrong by tens of per cent however deep the hierarchy is. A gradient at a
// leaf has no effect.
//
// If an end is a cluster the kernel is not linear: each face of the cluster is weighted by the projected area that it shows to the other
// end (cluster_exchange.hpp). For each end that is a cluster the link stores the direction to the other end; such links have no gradient,
// except that of a lamp's light over a patch (lamp_exchange.hpp).

#include <array>
#include <bit>
#include <cstdint>

#include <glm/vec3.hpp>

#include <radiosity/support/big_array.hpp>

namespace radiosity {

// How the light of a link is distributed over one of its ends. Three numbers in 6 bytes: the upper halves of floats (bfloat16), rounded
// to nearest. Relative error below 2^-8, with the range of float. This suffices because the gradient is only the linear part of a kernel.
class EndShape {
 public:
  EndShape() = default;  // constant over the end
  // For a patch: `g`, in its plane, is the relative change of the kernel per length.
  [[nodiscard]] static EndShape of_patch(const glm::vec3& g) { return EndShape{g}; }
  // For a cluster: `direction` (of length 1) points to the other end; `shown` is the projected area of the cluster in that direction.
  [[nodiscard]] static EndShape of_cluster(const glm::dvec3& direction, double shown) { return EndShape{glm::vec3{direction / shown}}; }

  // For a patch; 0 if the other end is a cluster that is not a lamp.
  [[nodiscard]] glm::dvec3 gradient() const { return vector(); }
  // For a cluster: the direction to the other end, divided by the projected area of the cluster in that direction.
  [[nodiscard]] glm::dvec3 direction_over_shown() const { return vector(); }

  // The direction after rounding to what a link can store. The projected area must be computed for this direction; otherwise the shares
  // of the faces would not sum to 1.
  [[nodiscard]] static glm::dvec3 stored_direction(const glm::dvec3& direction) { return EndShape{glm::vec3{direction}}.vector(); }

 private:
  explicit EndShape(const glm::vec3& v) : half_{round(v.x), round(v.y), round(v.z)} {}

  [[nodiscard]] glm::dvec3 vector() const { return {widen(half_[0]), widen(half_[1]), widen(half_[2])}; }
  [[nodiscard]] static std::uint16_t round(float x) {
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(x) + 0x8000u) >> 16);
  }
  [[nodiscard]] static double widen(std::uint16_t h) {
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(h) << 16));
  }
  std::array<std::uint16_t, 3> half_{};
};

struct Link {
  std::uint32_t p = 0;  // the nodes at its ends
  std::uint32_t q = 0;
  float exchange = 0.0f;  // G, in squared units of the frame
  EndShape shape_p{};
  EndShape shape_q{};
};
static_assert(sizeof(Link) == 24);  // the solver reads all links in each iteration

using Links = BigArray<Link>;

// Overload for LinkSchedule::arrange, which also takes records that contain a link.
[[nodiscard]] inline const Link& link_of(const Link& link) { return link; }

}  // namespace radiosity
