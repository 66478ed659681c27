// SPDX-License-Identifier: MIT
#pragma once

// halflight mesh SCENE [-o OUT.obj]: the polygons of each object as the solver sees them before it refines (paper 4.1: the
// approximation), with their counts, shells, genus, area and volume.
//
// What is written are the faces that give and receive light: a closed object is a closed mesh, a polygon is one face without its
// black back. The numbers are those of the written mesh, so `halflight check OUT` finds the same ones. Vertices and faces of
// different objects are never merged. Nothing is solved, and coordinates are those of the scene, unrounded.

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"

namespace apps {

struct MeshOptions {
  std::string scene;
  std::string output;               // empty: none
  std::optional<std::string> json;  // empty: standard output, in place of the text
};

void describe(CLI::App& command, MeshOptions& options);

[[nodiscard]] ExitCode run(const MeshOptions& options);

}  // namespace apps
