// SPDX-License-Identifier: MIT
#pragma once

// What a run gives back.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

struct Solution {
  Mesh mesh;                    // positions in the scene's own coordinates
  std::optional<Mesh> refined;  // the same light in finer faces (Options::mesh_error), where that was needed
  Audit audit;

  // The solution from which the mesh was made, in the coordinates of the frame.
  Frame frame;
  Hierarchy hierarchy;
  Links links;
  Links ray_links;               // made of stored rays, when light between surfaces that do not shine goes by these
  std::vector<double> area;      // exposed, one a node
  std::vector<double> row_sum;   // of the system that was solved, one a node; 0 at inner nodes
  std::vector<Color> radiosity;  // W/m2, one a node

  std::optional<Comparison> comparison;  // when asked for

  // The mesh that shows the light best: `refined` where there is one, else `mesh`.
  [[nodiscard]] const Mesh& shown() const { return refined ? *refined : mesh; }
};

struct Failure {
  // out_of_memory: the system has no more, or the run would need more than Options::memory.
  enum class Kind { invalid_scene, invalid_options, cancelled, out_of_memory };
  Kind kind = Kind::invalid_scene;
  std::vector<std::string> sentences;
};

struct Outcome {
  std::optional<Solution> solution;
  Failure failure;  // when there is no solution
};

namespace detail {

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

}  // namespace detail

}  // namespace radiosity
