// SPDX-License-Identifier: MIT
#pragma once

// Symmetric scaling of a matrix to given row sums: D with D S D 1 = t, for a symmetric S whose entries are, but for rounding, not negative.
// Newton's method, each step solved by conjugate gradients (Knight and Ruiz 2013). The plain iteration d_i *= sqrt(t_i / row i) halves what
// the constant has wrong in each round but leaves (1 - lambda) / 2 of an eigenvector of eigenvalue lambda, which is slow where two sides
// light each other and lambda is near -1.

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
  double tolerance = 1e-12;  // of row sums, relative
};

// The diagonal of D: 1 in rows with t = 0 and in those without light. As near as 400 products with S come where no D is within the limits,
// and never further than D = 1 is.
[[nodiscard]] std::vector<double> balance(const SymmetricOperator& apply, const std::vector<double>& t, const Balance& goal);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/balance.cpp>
#endif
