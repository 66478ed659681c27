// SPDX-License-Identifier: MIT
#pragma once

// A link carries light between two nodes at one level of the hierarchy. It is stored once for an unordered pair and used
// both ways, so reciprocity holds to the last bit and the operator of the linear system is symmetric.
//
// Between a point x of p and a point y of q the link stands for the kernel
//
//     K(x, y) = G / (A_p A_q) * (1 + slope_p . (x - c_p) + slope_q . (y - c_q))
//
// with G = A_p F_pq = A_q F_qp (visibility included) and c the area centroids. The constant term is the paper's link. The
// slopes make the light fall off across a large patch as it should: without them a leaf in the corner of a room inherits
// from each level above the mean over a patch that reaches far out of the corner, and its row sum errs by tens of
// per cent however deep the hierarchy is. The slope of an end that is a leaf has no effect. A link that has a cluster at an end has no
// slopes: the end that is a cluster keeps the direction to the other instead (cluster_exchange.hpp).

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity {

// Three numbers in 6 bytes: the upper halves of floats, rounded to nearest. Relative error below 2^-8, the range of float; a slope is
// itself only the linear part of a kernel.
class Slope {
 public:
  Slope() = default;
  Slope(const glm::vec3& v) : half_{round(v.x), round(v.y), round(v.z)} {}  // implicit: a slope is a vector

  [[nodiscard]] glm::dvec3 vector() const { return {widen(half_[0]), widen(half_[1]), widen(half_[2])}; }

 private:
  [[nodiscard]] static std::uint16_t round(float x) {
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(x) + 0x8000u) >> 16);
  }
  [[nodiscard]] static double widen(std::uint16_t h) {
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(h) << 16));
  }
  std::array<std::uint16_t, 3> half_{};
};

struct Link {
  std::uint32_t p = 0;
  std::uint32_t q = 0;
  float exchange = 0.0f;  // G, in the squared unit of the frame
  Slope slope_p{};        // in the plane of p, relative change per length
  Slope slope_q{};
};
static_assert(sizeof(Link) == 24);

using Links = std::vector<Link>;

}  // namespace radiosity
