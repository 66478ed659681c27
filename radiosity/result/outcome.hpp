// SPDX-License-Identifier: MIT
#pragma once

// What a run gives back, and the times of its stages.

#include <chrono>
#include <ctime>
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
  Mesh mesh;  // positions in the scene's own coordinates
  Audit audit;

  // What stands behind the mesh, in the coordinates of the frame.
  Frame frame;
  Hierarchy hierarchy;
  Links links;
  std::vector<double> area;      // exposed, one a node
  std::vector<double> row_sum;   // of the system that was solved, one a node; 0 at inner nodes
  std::vector<Color> radiosity;  // W/m2, one a node

  std::optional<Comparison> comparison;  // when asked for
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

// Measures the wall and CPU time of stages that follow one another, and the memory at their ends.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& stages) : stages_{&stages} {}

  // Ends the stage that began with the last call (or the construction).
  void lap(std::string name);

 private:
  std::vector<StageTime>* stages_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// Adds the times of one round to those of the rounds before it, stage by stage.
void add_times(std::vector<StageTime>& total, const std::vector<StageTime>& round);

// The total, of which neither the audit nor a comparison is a part.
void sum_times(Audit& audit);

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/outcome.cpp>
#endif
