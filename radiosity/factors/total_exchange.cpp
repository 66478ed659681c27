// SPDX-License-Identifier: MIT
#include <radiosity/factors/total_exchange.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factors.hpp>

namespace radiosity {

namespace detail {

// Cholesky factor of a symmetric matrix stored row by row; overwrites its lower triangle. Returns false if the matrix is not positive
// definite: if a pivot is below 1e-12 of its diagonal entry.
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

// The matrices of total_exchange.hpp during the computation of K: n x n, row by row.
struct ExchangeMatrices {
  const Factors& factors;
  std::span<const double> emissivity;
  std::size_t n = factors.surfaces.size();
  std::vector<double> exchange = std::vector<double>(n * n, 0.0);  // G, then K without the emissivities
  std::vector<double> variance = std::vector<double>(n * n, 0.0);  // of the entries of `exchange`
  std::vector<double> system = std::vector<double>(n * n, 0.0);    // T, then its Cholesky factor

  // A buried surface has no area and takes no part; 1 avoids a division by 0.
  [[nodiscard]] double area(std::size_t i) const { return factors.surfaces[i].area.value > 0.0 ? factors.surfaces[i].area.value : 1.0; }
  [[nodiscard]] double root(std::size_t i) const { return std::sqrt(1.0 - emissivity[i]); }

  // G with its variances, and T.
  void fill() {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        // Both rows of a pair store the same exchange; their products with the areas differ by rounding, so one of them is used.
        const std::size_t from = std::min(i, j);
        const std::size_t to = std::max(i, j);
        exchange[i * n + j] = area(from) * factors(from, to).value;
        const double error = std::max(area(i) * factors(i, j).error, area(j) * factors(j, i).error);
        variance[i * n + j] = error * error * (i == j ? 1.0 : 2.0);  // G_ij and G_ji have the same error
        system[i * n + j] = (i == j ? area(i) : 0.0) - root(i) * exchange[i * n + j] * root(j);
      }
    }
  }

  // After the Cholesky step: adds to G the light that arrives after reflections, W^T W.
  void add_reflected() {
    std::vector<double> w(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      double* const row = w.data() + i * n;
      for (std::size_t j = 0; j < n; ++j) { row[j] = root(i) * exchange[i * n + j]; }
      for (std::size_t l = 0; l < i; ++l) {
        const double x = system[i * n + l];
        for (std::size_t j = 0; j < n; ++j) { row[j] -= x * w[l * n + j]; }
      }
      for (std::size_t j = 0; j < n; ++j) { row[j] /= system[i * n + i]; }
    }
    for (std::size_t l = 0; l < n; ++l) {
      const double* const row = w.data() + l * n;
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) { exchange[i * n + j] += row[i] * row[j]; }
      }
    }
  }

  // Propagates the variances of G to those of K, with the squared entries of P and of its transpose.
  void carry_variances() {
    std::vector<double>& p = system;  // no longer needed
    std::vector<double> transposed(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double entry = (i == j ? 1.0 : 0.0) + exchange[i * n + j] * (1.0 - emissivity[j]) / area(j);
        p[i * n + j] = transposed[j * n + i] = entry * entry;
      }
    }
    std::vector<double> half(n * n, 0.0);
    add_product(p, variance, half, n);
    std::fill(variance.begin(), variance.end(), 0.0);
    add_product(half, transposed, variance, n);
  }

  [[nodiscard]] TotalExchange result() const {
    TotalExchange result;
    result.factor.resize(n * n);
    result.row_sum.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      double square = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        const double both = emissivity[i] * emissivity[j] / area(i);
        const Estimate factor{both * exchange[i * n + j], both * std::sqrt(variance[i * n + j])};
        result.factor[i * n + j] = factor;
        result.row_sum[i].value += factor.value;
        square += factor.error * factor.error;
      }
      result.row_sum[i].error = std::sqrt(square);
    }
    return result;
  }
};

}  // namespace detail

HALFLIGHT_INLINE TotalExchangeResult total_exchange(const Factors& factors, std::span<const double> emissivity) {
  if (emissivity.size() != factors.surfaces.size()) { return {std::nullopt, "there must be one emissivity a surface"}; }
  for (const double e : emissivity) {
    if (!(e >= 0.0 && e <= 1.0)) { return {std::nullopt, "emissivity " + std::to_string(e) + " lies outside [0, 1]"}; }
  }
  detail::ExchangeMatrices matrices{factors, emissivity};
  matrices.fill();
  if (!detail::cholesky(matrices.system, matrices.n)) {
    return {std::nullopt,
            "the surfaces emit and absorb too little (or nothing) of the light that goes round between them; "
            "there is no steady state, or no figure of it is certain"};
  }
  matrices.add_reflected();
  matrices.carry_variances();
  return {matrices.result(), {}};
}

}  // namespace radiosity
