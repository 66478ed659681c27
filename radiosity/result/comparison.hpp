// SPDX-License-Identifier: MIT
#pragma once

// What a study needs besides the solution of a run, to separate the sources of its error: the mesh with the other reconstruction, and a
// dense solution on the same leaves (dense.hpp). Neither counts in the times of the run.

#include <vector>

#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct Comparison {
  Mesh other;
  std::vector<Color> dense;  // W/m2, by node, set for leaves; empty if there were too many
};

[[nodiscard]] constexpr Reconstruction other(Reconstruction kind) {
  return kind == Reconstruction::simple ? Reconstruction::weighted : Reconstruction::simple;
}

}  // namespace radiosity
