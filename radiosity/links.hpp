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
// per cent however deep the hierarchy is. The slope of an end that is a leaf has no effect.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity {

struct Link {
  std::uint32_t p = 0;
  std::uint32_t q = 0;
  float exchange = 0.0f;    // G, in the squared unit of the frame
  glm::vec3 slope_p{0.0f};  // in the plane of p, relative change per length
  glm::vec3 slope_q{0.0f};
};
static_assert(sizeof(Link) == 36);

using Links = std::vector<Link>;

}  // namespace radiosity
