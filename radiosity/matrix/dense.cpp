// SPDX-License-Identifier: MIT
#include <radiosity/matrix/dense.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE DenseMatrix make_matrix(const LeafExchange& exchange, unsigned threads, const Control& control) {
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

HALFLIGHT_INLINE double explained_closure(const DenseMatrix& matrix, const LeafExchange& exchange) {
  double total = 0.0;
  for (std::size_t i = 0; i < matrix.size; ++i) { total += exchange.area(i); }
  return explained_closure(matrix.doubt, {}, {}, total);
}

HALFLIGHT_INLINE std::optional<double> close_rows(DenseMatrix& matrix, const LeafExchange& exchange, double limit) {
  const std::size_t n = matrix.size;
  std::vector<double> scale(n, 1.0);
  double rms = 0.0;  // error of the row sums before scaling
  for (int round = 0; round < 400; ++round) {
    double worst = 0.0, square = 0.0, total = 0.0;
    std::vector<double> next(scale);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) { sum += static_cast<double>(matrix.row(i)[j]) * scale[j]; }
      sum *= scale[i] / exchange.area(i);
      total += exchange.area(i);
      if (!(sum > 0.0)) { continue; }
      square += exchange.area(i) * (sum - 1.0) * (sum - 1.0);
      worst = std::max(worst, std::abs(sum - 1.0));
      next[i] /= std::sqrt(sum);
    }
    if (round == 0 && total > 0.0) { rms = std::sqrt(square / total); }
    if (!(rms <= limit)) { return std::nullopt; }
    scale = std::move(next);
    if (worst < 1e-9) { break; }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) { matrix.entry[i * n + j] *= static_cast<float>(scale[i] * scale[j]); }
  }
  return rms;
}

HALFLIGHT_INLINE DenseSolution gauss_seidel(const DenseMatrix& matrix, const LeafExchange& exchange, const LeafMaterials& materials,
                                            double wanted, std::uint32_t max_iterations, const Control& control) {
  const std::size_t n = matrix.size;
  DenseSolution solution;
  std::vector<Color>& b = solution.radiosity;
  b = materials.emission;
  const auto gathered = [&](std::size_t i) {
    Color sum{0.0};
    for (std::size_t j = 0; j < n; ++j) { sum += static_cast<double>(matrix.row(i)[j]) * b[j]; }
    return materials.emission[i] + materials.reflectance[i] * sum / exchange.area(i);
  };
  double emitted = 0.0, reflected = 0.0;
  for (std::size_t i = 0; i < n; ++i) { emitted += exchange.area(i) * glm::dot(materials.emission[i], materials.emission[i]); }
  for (;; ++solution.iterations) {
    double square = 0.0, known = 0.0;  // known: of reflecting leaves
    for (std::size_t i = 0; i < n; ++i) {
      const Color r = gathered(i) - b[i];
      square += exchange.area(i) * glm::dot(r, r);
      if (brightest(materials.reflectance[i]) > 0.0) { known += exchange.area(i) * glm::dot(b[i], b[i]); }
    }
    if (solution.iterations == 0) { reflected = std::sqrt(square); }
    solution.residual = emitted > 0.0 ? std::sqrt(square / emitted) : 0.0;
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * std::sqrt(known);
    solution.converged = std::sqrt(square) <= std::max(wanted * reflected, rounding);
    solution.cancelled = control.cancelled();
    if (solution.converged || solution.cancelled || solution.iterations == max_iterations) { return solution; }
    for (std::size_t i = 0; i < n; ++i) { b[i] = gathered(i); }
  }
}

HALFLIGHT_INLINE DenseSolution shoot(const LeafExchange& exchange, const LeafMaterials& materials, double wanted, std::uint64_t max_shots,
                                     unsigned threads, const Control& control) {
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
      const double power = exchange.area(i) * sum_of_channels(unshot[i]);
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

HALFLIGHT_INLINE std::vector<Color> dense_radiosity(const DiscreteScene& scene, const LeafExchange& exchange,
                                                    const LeafMaterials& materials, double residual) {
  DenseMatrix matrix = make_matrix(exchange, scene.threads, scene.control);
  if (matrix.cancelled) { return {}; }
  if (scene.plan.closed) { (void)close_rows(matrix, exchange, explained_closure(matrix, exchange)); }
  const DenseSolution solved = gauss_seidel(matrix, exchange, materials, residual, 1000, scene.control);
  if (solved.cancelled) { return {}; }
  std::vector<Color> result(scene.hierarchy.size(), Color{0.0});
  for (std::size_t i = 0; i < exchange.size(); ++i) { result[exchange.node(i)] = solved.radiosity[i]; }
  return result;
}

}  // namespace radiosity
