// SPDX-License-Identifier: MIT
#pragma once

// What a study wants beside the solution of a run, to tell apart where its error comes from: the mesh with the reconstruction that
// was not asked for, and what a dense solution finds on the very same leaves (dense.hpp). Neither counts in the times of the run.

#include <vector>

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

}  // namespace radiosity
