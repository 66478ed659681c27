// SPDX-License-Identifier: MIT
#pragma once

// What a study wants beside the solution of a run, to tell apart where its error comes from: the mesh with the reconstruction that
// was not asked for, and what a dense solution finds on the very same leaves (dense.hpp). Neither counts in the times of the run.

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/matrix/dense.hpp>
#include <radiosity/matrix/leaf_exchange.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct Comparison {
  Mesh other;
  std::vector<Color> dense;  // W/m2, one a node, of leaves; empty when there were too many
};

[[nodiscard]] constexpr Reconstruction other(Reconstruction kind) {
  return kind == Reconstruction::simple ? Reconstruction::weighted : Reconstruction::simple;
}

// The radiosity of the leaves by Gauss-Seidel on the full matrix; empty when cancelled. One entry a node.
[[nodiscard]] inline std::vector<Color> dense_radiosity(const LeafExchange& exchange, const LeafMaterials& materials, bool closed,
                                                        std::size_t nodes, double residual, unsigned threads, const Control& control) {
  DenseMatrix matrix = make_matrix(exchange, threads, control);
  if (matrix.cancelled) { return {}; }
  if (closed) { (void)close_rows(matrix, exchange, explained_closure(matrix, exchange)); }
  const DenseSolution solved = gauss_seidel(matrix, exchange, materials, residual, 1000, control);
  if (solved.cancelled) { return {}; }
  std::vector<Color> result(nodes, Color{0.0});
  for (std::size_t i = 0; i < exchange.size(); ++i) { result[exchange.node(i)] = solved.radiosity[i]; }
  return result;
}

}  // namespace radiosity
