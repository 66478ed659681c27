// SPDX-License-Identifier: MIT
#pragma once

// The result of a run.

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
  Mesh mesh;                    // positions in scene coordinates
  std::optional<Mesh> refined;  // the same light on finer faces (Options::mesh_error), if that was needed
  Audit audit;

  // The solution from which the mesh was made, in coordinates of the frame.
  Frame frame;
  Hierarchy hierarchy;
  Links links;
  Links ray_links;               // made of stored rays, if these carry the light between surfaces that are not lamps
  std::vector<double> area;      // exposed area, by node
  std::vector<double> row_sum;   // of the system that was solved, by node; 0 at inner nodes
  std::vector<Color> radiosity;  // W/m2, by node

  std::optional<Comparison> comparison;  // if requested

  // The mesh with the best light: `refined` if it exists, otherwise `mesh`.
  [[nodiscard]] const Mesh& shown() const { return refined ? *refined : mesh; }
};

struct Failure {
  // out_of_memory: an allocation failed, or the run would need more than Options::memory.
  enum class Kind { invalid_scene, invalid_options, cancelled, out_of_memory };
  Kind kind = Kind::invalid_scene;
  std::vector<std::string> sentences;
};

struct Outcome {
  std::optional<Solution> solution;
  Failure failure;  // if there is no solution
};

namespace detail {

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

}  // namespace detail

}  // namespace radiosity
