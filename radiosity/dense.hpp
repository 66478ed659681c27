// SPDX-License-Identifier: MIT
#pragma once

// Radiosity without links: the two classical ways to solve for the leaves.
//
//   Gauss-Seidel   stores the n x n matrix and gathers into one leaf after the other
//   progressive    stores nothing: the leaf with the most unshot power shoots it, its row made anew each time (Cohen et al. 1988)
//
// Exchanges are those of the links (leaf_exchange.hpp), so a dense solution on the leaves of a hierarchical run shows what the links
// alone got wrong. Cost: n^2 / 2 exchanges for the matrix, n a shot.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <radiosity/leaf_exchange.hpp>
#include <radiosity/material.hpp>
#include <radiosity/options.hpp>
#include <radiosity/parallel.hpp>

namespace radiosity {

// All exchanges, row by row; symmetric, with an empty diagonal.
struct DenseMatrix {
  std::size_t size = 0;
  std::vector<float> entry;
  RayCount rays;
  DoubtSum doubt;  // of the rows
  bool cancelled = false;

  [[nodiscard]] const float* row(std::size_t i) const { return entry.data() + i * size; }
};

[[nodiscard]] inline DenseMatrix make_matrix(const LeafExchange& exchange, unsigned threads, const Control& control = {}) {
  const std::size_t n = exchange.size();
  DenseMatrix matrix{n, std::vector<float>(n * n, 0.0f), {}, {}, false};
  std::vector<RayCount> rays(n);
  std::vector<DoubtSum> doubts(n);
  parallel_for(
      n, threads,
      [&](std::size_t i) {
        if (control.cancelled()) { return; }
        for (std::size_t j = i + 1; j < n; ++j) {
          Doubt doubt;
          matrix.entry[i * n + j] = matrix.entry[j * n + i] = exchange(i, j, rays[i], &doubt);
          doubts[i].add(exchange.node(i), exchange.node(j), doubt);
        }
      },
      4);
  for (const RayCount& r : rays) { matrix.rays += r; }
  for (const DoubtSum& d : doubts) { matrix.doubt.add(d); }
  matrix.cancelled = control.cancelled();
  return matrix;
}

// The most that may be wrong with the rows of a closed scene.
[[nodiscard]] inline double explained_closure(const DenseMatrix& matrix, const LeafExchange& exchange) {
  double total = 0.0;
  for (std::size_t i = 0; i < matrix.size; ++i) { total += exchange.area(i); }
  return explained_closure(matrix.doubt, {}, total);
}

// Makes the rows of a closed scene sum to 1, as Transport::close() does. Returns the RMS correction, or nothing, and changes nothing,
// when it is beyond `limit`.
[[nodiscard]] inline std::optional<double> close_rows(DenseMatrix& matrix, const LeafExchange& exchange, double limit) {
  const std::size_t n = matrix.size;
  std::vector<double> scale(n, 1.0);
  for (int round = 0; round < 400; ++round) {
    double worst = 0.0;
    std::vector<double> next(scale);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) { sum += static_cast<double>(matrix.row(i)[j]) * scale[j]; }
      sum *= scale[i] / exchange.area(i);
      if (!(sum > 0.0)) { continue; }
      worst = std::max(worst, std::abs(sum - 1.0));
      next[i] /= std::sqrt(sum);
    }
    scale = std::move(next);
    if (worst < 1e-9) { break; }
  }
  double square = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    square += exchange.area(i) * (scale[i] - 1.0) * (scale[i] - 1.0);
    total += exchange.area(i);
  }
  const double rms = total > 0.0 ? std::sqrt(square / total) : 0.0;
  if (!(rms <= limit)) { return std::nullopt; }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) { matrix.entry[i * n + j] *= static_cast<float>(scale[i] * scale[j]); }
  }
  return rms;
}

struct DenseSolution {
  std::vector<Color> radiosity;  // of the leaves
  double residual = 0.0;         // || E + rho H(B) - B || / || E ||, area-weighted; of shooting: unshot power / emitted power
  std::uint64_t iterations = 0;  // sweeps; of shooting: shots
  RayCount rays;
  bool converged = false;
  bool cancelled = false;
};

// Gauss-Seidel until the residual is at most `wanted`.
[[nodiscard]] inline DenseSolution gauss_seidel(const DenseMatrix& matrix, const LeafExchange& exchange, const LeafMaterials& materials,
                                                double wanted, std::uint32_t max_iterations, const Control& control = {}) {
  const std::size_t n = matrix.size;
  DenseSolution solution;
  std::vector<Color>& b = solution.radiosity;
  b = materials.emission;
  const auto gathered = [&](std::size_t i) {
    Color sum{0.0};
    for (std::size_t j = 0; j < n; ++j) { sum += static_cast<double>(matrix.row(i)[j]) * b[j]; }
    return materials.emission[i] + materials.reflectance[i] * sum / exchange.area(i);
  };
  double emitted = 0.0;
  for (std::size_t i = 0; i < n; ++i) { emitted += exchange.area(i) * glm::dot(materials.emission[i], materials.emission[i]); }
  for (;; ++solution.iterations) {
    double square = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const Color r = gathered(i) - b[i];
      square += exchange.area(i) * glm::dot(r, r);
    }
    solution.residual = emitted > 0.0 ? std::sqrt(square / emitted) : 0.0;
    solution.converged = solution.residual <= wanted;
    solution.cancelled = control.cancelled();
    if (solution.converged || solution.cancelled || solution.iterations == max_iterations) { return solution; }
    for (std::size_t i = 0; i < n; ++i) { b[i] = gathered(i); }
  }
}

// Shooting until no more than the fraction `wanted` of the emitted power is unshot.
[[nodiscard]] inline DenseSolution shoot(const LeafExchange& exchange, const LeafMaterials& materials, double wanted,
                                         std::uint64_t max_shots, unsigned threads, const Control& control = {}) {
  const std::size_t n = exchange.size();
  DenseSolution solution;
  std::vector<Color> unshot(materials.emission);
  solution.radiosity = materials.emission;
  std::vector<float> row(n);
  std::vector<RayCount> rays(n);
  double emitted = 0.0;
  for (;; ++solution.iterations) {
    std::size_t brightest = 0;
    double most = -1.0;
    double left = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double power = exchange.area(i) * (unshot[i].x + unshot[i].y + unshot[i].z);
      left += power;
      if (power > most) {
        most = power;
        brightest = i;
      }
    }
    if (solution.iterations == 0) { emitted = left; }
    solution.residual = emitted > 0.0 ? left / emitted : 0.0;
    solution.converged = solution.residual <= wanted;
    solution.cancelled = control.cancelled();
    if (solution.converged || solution.cancelled || solution.iterations == max_shots) { break; }
    parallel_for(n, threads, [&](std::size_t j) { row[j] = exchange(brightest, j, rays[j]); });
    const Color shot = std::exchange(unshot[brightest], Color{0.0});
    for (std::size_t j = 0; j < n; ++j) {
      const Color arrived = materials.reflectance[j] * shot * (static_cast<double>(row[j]) / exchange.area(j));
      solution.radiosity[j] += arrived;
      unshot[j] += arrived;
    }
  }
  for (const RayCount& r : rays) { solution.rays += r; }
  return solution;
}

}  // namespace radiosity
