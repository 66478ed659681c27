// SPDX-License-Identifier: MIT
#pragma once

// What a run gives back, and the times of its stages.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/audit.hpp>
#include <radiosity/comparison.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/links.hpp>
#include <radiosity/material.hpp>
#include <radiosity/memory.hpp>
#include <radiosity/mesh.hpp>

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
  void lap(std::string name) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    stages_->push_back({std::move(name), std::chrono::duration<double>(wall - wall_).count(),
                        static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC, peak_memory()});
    wall_ = wall;
    cpu_ = cpu;
  }

 private:
  std::vector<StageTime>* stages_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// Adds the times of one round to those of the rounds before it, stage by stage.
inline void add_times(std::vector<StageTime>& total, const std::vector<StageTime>& round) {
  for (const StageTime& stage : round) {
    auto same = std::find_if(total.begin(), total.end(), [&](const StageTime& t) { return t.name == stage.name; });
    if (same == total.end()) { same = total.insert(same, {stage.name, 0.0, 0.0}); }
    same->wall_seconds += stage.wall_seconds;
    same->cpu_seconds += stage.cpu_seconds;
    same->peak_bytes = stage.peak_bytes;
  }
}

// The total, of which neither the audit nor a comparison is a part.
inline void sum_times(Audit& audit) {
  audit.wall_seconds = 0.0;
  audit.cpu_seconds = 0.0;
  for (const StageTime& stage : audit.stages) {
    if (stage.name == "audit" || stage.name == "compare") { continue; }
    audit.wall_seconds += stage.wall_seconds;
    audit.cpu_seconds += stage.cpu_seconds;
  }
}

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

}  // namespace detail

}  // namespace radiosity
