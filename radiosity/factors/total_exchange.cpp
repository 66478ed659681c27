// SPDX-License-Identifier: MIT
#include <radiosity/factors/total_exchange.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factors.hpp>

namespace radiosity {

namespace detail {

// Of a symmetric matrix, row by row, its lower triangle in place; false when it is not positive definite: when a pivot loses all but 1e-12
// of its diagonal entry.
[[nodiscard]] HALFLIGHT_INLINE bool cholesky(std::vector<double>& a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double diagonal = a[i * n + i];
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) { sum -= a[i * n + k] * a[j * n + k]; }
      if (j < i) {
        a[i * n + j] = sum / a[j * n + j];
      } else if (sum > 1e-12 * diagonal) {
        a[i * n + i] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  return true;
}

// c += a b, all n x n.
HALFLIGHT_INLINE void add_product(const std::vector<double>& a, const std::vector<double>& b, std::vector<double>& c, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      const double x = a[i * n + k];
      if (x == 0.0) { continue; }
      for (std::size_t j = 0; j < n; ++j) { c[i * n + j] += x * b[k * n + j]; }
    }
  }
}

}  // namespace detail

HALFLIGHT_INLINE TotalExchangeResult total_exchange(const Factors& factors, std::span<const double> emissivity) {
  const std::size_t n = factors.surfaces.size();
  if (emissivity.size() != n) { return {std::nullopt, "there must be one emissivity a surface"}; }
  for (const double e : emissivity) {
    if (!(e >= 0.0 && e <= 1.0)) { return {std::nullopt, "emissivity " + std::to_string(e) + " lies outside [0, 1]"}; }
  }
  // What is buried has no area and takes no part.
  const auto area = [&](std::size_t i) { return factors.surfaces[i].area.value > 0.0 ? factors.surfaces[i].area.value : 1.0; };
  const auto root = [&](std::size_t i) { return std::sqrt(1.0 - emissivity[i]); };
  std::vector<double> k(n * n, 0.0);  // G
  std::vector<double> variance(n * n, 0.0);
  std::vector<double> t(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      // Both ends know the same exchange; their quotients by the areas differ by rounding.
      const std::size_t from = std::min(i, j);
      const std::size_t to = std::max(i, j);
      k[i * n + j] = area(from) * factors(from, to).value;
      const double error = std::max(area(i) * factors(i, j).error, area(j) * factors(j, i).error);
      variance[i * n + j] = error * error * (i == j ? 1.0 : 2.0);  // G_ij and G_ji err together
      t[i * n + j] = (i == j ? area(i) : 0.0) - root(i) * k[i * n + j] * root(j);
    }
  }
  if (!detail::cholesky(t, n)) {
    return {std::nullopt,
            "the surfaces emit and absorb too little (or nothing) of the light that goes round between them; "
            "there is no steady state, or no figure of it is certain"};
  }
  std::vector<double> w(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = w.data() + i * n;
    for (std::size_t j = 0; j < n; ++j) { row[j] = root(i) * k[i * n + j]; }
    for (std::size_t l = 0; l < i; ++l) {
      const double x = t[i * n + l];
      for (std::size_t j = 0; j < n; ++j) { row[j] -= x * w[l * n + j]; }
    }
    for (std::size_t j = 0; j < n; ++j) { row[j] /= t[i * n + i]; }
  }
  for (std::size_t l = 0; l < n; ++l) {
    const double* const row = w.data() + l * n;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) { k[i * n + j] += row[i] * row[j]; }
    }
  }
  // Squares of P and of its transpose; then the variances of K.
  std::vector<double>& p = t;
  std::vector<double>& q = w;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double entry = (i == j ? 1.0 : 0.0) + k[i * n + j] * (1.0 - emissivity[j]) / area(j);
      p[i * n + j] = q[j * n + i] = entry * entry;
    }
  }
  std::vector<double> half(n * n, 0.0);
  detail::add_product(p, variance, half, n);
  std::fill(variance.begin(), variance.end(), 0.0);
  detail::add_product(half, q, variance, n);

  TotalExchange result;
  result.factor.resize(n * n);
  result.row_sum.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      const double both = emissivity[i] * emissivity[j] / area(i);
      const Estimate factor{both * k[i * n + j], both * std::sqrt(variance[i * n + j])};
      result.factor[i * n + j] = factor;
      result.row_sum[i].value += factor.value;
      square += factor.error * factor.error;
    }
    result.row_sum[i].error = std::sqrt(square);
  }
  return {std::move(result), {}};
}

}  // namespace radiosity
