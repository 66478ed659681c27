// SPDX-License-Identifier: MIT
#pragma once

// Radiosity without a hierarchy, as it was before: every input face is cut evenly, regardless of the light, and every leaf exchanges
// light with every other, by a full matrix (Goral et al. 1984, here with Gauss-Seidel) or by shooting (Cohen et al. 1988); or each leaf
// gathers over its own rays, as in a simple program (gather_lists.hpp). The other stages are those of radiosity.hpp, and the result has
// the same form.

#include <cstdint>
#include <optional>

#include <radiosity/matrix/gather_lists.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

enum class UniformSolver { gauss_seidel, progressive, gather_lists };

struct UniformOptions {
  UniformSolver solver = UniformSolver::gauss_seidel;
  double max_area = 1e-3;            // largest leaf, relative to the total area of the scene
  double residual = 1e-8;            // of Gauss-Seidel and gather_lists, relative to the emission
  double unshot = 1e-2;              // of shooting: power at which it ends, relative to the emitted power
  ListEffort lists;                  // of gather_lists
  std::uint32_t max_leaves = 20000;  // more are refused, because the matrix takes 4 bytes per pair
  Reconstruction reconstruction = Reconstruction::weighted;
  std::optional<std::uint32_t> compare;  // as in Options
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> memory;  // as in Options
};

// Audit::links counts the entries of the matrix, the exchanges that were computed and not kept, or the stored rays. The error is not
// estimated.
[[nodiscard]] Outcome solve_uniform(const Scene& scene, const UniformOptions& options, const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/uniform.cpp>
#endif
