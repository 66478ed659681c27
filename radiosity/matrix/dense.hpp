// SPDX-License-Identifier: MIT
#pragma once

// Radiosity without links: the two classical ways to solve for the leaves.
//
//   Gauss-Seidel   stores the n x n matrix and gathers into one leaf after the other
//   progressive    stores nothing: the leaf with the most unshot power shoots it, its row made anew each time (Cohen et al. 1988)
//
// Exchanges are those of the links (leaf_exchange.hpp), so a dense solution on the leaves of a hierarchical run shows what the links
// alone got wrong. Cost: n^2 / 2 exchanges for the matrix, n a shot.

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

// All exchanges, row by row; symmetric, with an empty diagonal.
struct DenseMatrix {
  std::size_t size = 0;
  std::vector<float> entry;
  RayCount rays;
  DoubtSum doubt;  // of the rows
  bool cancelled = false;

  [[nodiscard]] const float* row(std::size_t i) const { return entry.data() + i * size; }
};

[[nodiscard]] DenseMatrix make_matrix(const LeafExchange& exchange, unsigned threads, const Control& control = {});

// The most that may be wrong with the rows of a closed scene.
[[nodiscard]] double explained_closure(const DenseMatrix& matrix, const LeafExchange& exchange);

// Makes the rows of a closed scene sum to 1, as Transport::close() does. Returns the RMS by which they were off, or nothing, and changes
// nothing, when that is beyond `limit`.
[[nodiscard]] std::optional<double> close_rows(DenseMatrix& matrix, const LeafExchange& exchange, double limit);

struct DenseSolution {
  std::vector<Color> radiosity;  // of the leaves
  double residual = 0.0;         // || E + rho H(B) - B || / || E ||, area-weighted; of shooting: unshot power / emitted power
  std::uint64_t iterations = 0;  // sweeps; of shooting: shots
  std::uint64_t exchanges = 0;   // of lists alone: rays that were kept
  RayCount rays;
  bool converged = false;
  bool cancelled = false;
};

// Gauss-Seidel until the residual is at most `wanted` times that of B = E, or rounding.
[[nodiscard]] DenseSolution gauss_seidel(const DenseMatrix& matrix, const LeafExchange& exchange, const LeafMaterials& materials,
                                         double wanted, std::uint32_t max_iterations, const Control& control = {});

// Shooting until no more than the fraction `wanted` of the emitted power is unshot.
[[nodiscard]] DenseSolution shoot(const LeafExchange& exchange, const LeafMaterials& materials, double wanted, std::uint64_t max_shots,
                                  unsigned threads, const Control& control = {});

// The radiosity of the leaves by Gauss-Seidel on the full matrix; empty when cancelled. One entry a node.
[[nodiscard]] std::vector<Color> dense_radiosity(const DiscreteScene& scene, const LeafExchange& exchange, const LeafMaterials& materials,
                                                 double residual);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/matrix/dense.cpp>
#endif
