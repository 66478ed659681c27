// SPDX-License-Identifier: MIT
#pragma once

// Radiosity without links: the two classical ways to solve for the leaves.
//
//   Gauss-Seidel   stores the n x n matrix and updates one leaf after the other
//   progressive    stores no matrix: the leaf with the most unshot power shoots it; its row is computed anew each time (Cohen et al. 1988)
//
// Exchanges are computed as for links (leaf_exchange.hpp), so a dense solution on the leaves of a hierarchical run shows the error of the
// links alone. Cost: n^2 / 2 exchanges for the matrix, n per shot.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// All exchanges, row by row; symmetric, with a zero diagonal.
struct DenseMatrix {
  std::size_t size = 0;
  std::vector<float> entry;
  RayCount rays;
  DoubtSum doubt;  // of the rows
  bool cancelled = false;

  [[nodiscard]] const float* row(std::size_t i) const { return entry.data() + i * size; }
};

[[nodiscard]] DenseMatrix make_matrix(const LeafExchange& exchange, unsigned threads, const Control& control);

// Largest error of the row sums of a closed scene that the matrix explains.
[[nodiscard]] double explained_closure(const DenseMatrix& matrix, const LeafExchange& exchange);

// Scales the matrix so that the rows of a closed scene sum to 1, as Transport::close() does. Returns the RMS error of the row sums
// before; if that exceeds `limit`, returns nothing and changes nothing.
[[nodiscard]] std::optional<double> close_rows(DenseMatrix& matrix, const LeafExchange& exchange, double limit);

struct DenseSolution {
  std::vector<Color> radiosity;  // of the leaves
  double residual = 0.0;         // || E + rho H(B) - B || / || E ||, area-weighted; for shooting: unshot power / emitted power
  std::uint64_t iterations = 0;  // sweeps; for shooting: shots
  std::uint64_t exchanges = 0;   // only for gather lists: number of rays kept
  RayCount rays;
  bool converged = false;
  bool cancelled = false;
};

// Gauss-Seidel until the residual is at most `wanted` times that of B = E, or down to rounding.
[[nodiscard]] DenseSolution gauss_seidel(const DenseMatrix& matrix, const LeafExchange& exchange, const LeafMaterials& materials,
                                         double wanted, std::uint32_t max_iterations, const Control& control = {});

// Shoots until at most the fraction `wanted` of the emitted power is unshot.
[[nodiscard]] DenseSolution shoot(const LeafExchange& exchange, const LeafMaterials& materials, double wanted, std::uint64_t max_shots,
                                  unsigned threads, const Control& control = {});

// The radiosity of the leaves by Gauss-Seidel on the full matrix, one entry per node; empty when cancelled.
[[nodiscard]] std::vector<Color> dense_radiosity(const DiscreteScene& scene, const LeafExchange& exchange, const LeafMaterials& materials,
                                                 double residual);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/matrix/dense.cpp>
#endif
