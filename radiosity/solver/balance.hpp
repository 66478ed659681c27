// SPDX-License-Identifier: MIT
#pragma once

// Symmetric scaling of a matrix to given row sums: finds a diagonal D with D S D 1 = t, for a symmetric S whose entries are non-negative
// up to rounding. Newton's method for log D, each step solved by conjugate gradients (Knight and Ruiz 2013). The simple iteration
// d_i *= sqrt(t_i / row i) halves a constant error in each round but reduces an eigenvector with eigenvalue lambda only by the factor
// (1 - lambda) / 2, which is slow if two sides light each other and lambda is near -1. Newton's steps along such an eigenvector are large.
// For log D they are exact, because a factor of one side and its inverse on the other change nothing; for D itself, whose linear system
// is the same, they may lead away from the goal.

#include <functional>
#include <limits>
#include <vector>

namespace radiosity {

// y = S x.
using SymmetricOperator = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

struct ScaleLimits {
  double least = 0.0, most = std::numeric_limits<double>::infinity();
};
struct Balance {
  ScaleLimits limits{};
  double tolerance = 1e-12;  // relative error of the row sums
};

// Returns the diagonal of D, with 1 in rows with t = 0 or without entries. If no D is within the limits, returns the best one found until
// five rounds, but for those that are far away, have come no nearer, or with 400 products with S, which is never worse than D = 1.
[[nodiscard]] std::vector<double> balance(const SymmetricOperator& apply, const std::vector<double>& t, const Balance& goal);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/balance.cpp>
#endif
