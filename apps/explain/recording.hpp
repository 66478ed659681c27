// SPDX-License-Identifier: MIT
#pragma once

// Records how a solution comes about, for scenes small enough to be viewed completely: every pair that the oracles were asked about and
// why it was linked or split (paper 4.3, 4.4), the rays of every link, the effect of gather, push and pull in each iteration, T-vertices,
// BF-refinement by generation, and a comparison of the solvers. Page and text show what is recorded here and compute nothing.
//
// The stages of a run (radiosity/run/stages.hpp) do the work; Control::decided reports the decisions of the refinement.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>

namespace apps::explain {

struct Wanted {
  double epsilon = 0.05;
  double min_area = 2e-3;
  std::optional<double> light_epsilon;  // default: epsilon, so that the form factor decides first
  double target = 0.1;                  // error target of BF-refinement
};

// The largest size that can be viewed completely. A scene that needs more is refused with a sentence that gives the number and advice.
inline constexpr std::size_t most_faces = 256, most_nodes = 3000, most_pairs = 12000;

struct Pair {
  std::uint32_t p = 0, q = 0;
  std::optional<std::uint32_t> parent;  // the pair whose split created this one
  std::uint32_t generation = 0;
  double estimate = 0.0;  // the larger of the two disk estimates, paper 4.3
  radiosity::Decision by_form_factor = radiosity::Decision::link;
  radiosity::Decision decision = radiosity::Decision::link;
  bool by_light = false;  // was it a link until it was split because of the light that it carried?
  std::string sentence;
};

struct Ray {
  glm::dvec3 from{0.0}, to{0.0};
  bool arrives = false;
};

struct LinkRecord {
  std::uint32_t p = 0, q = 0;
  double exchange = 0.0, unoccluded = 0.0;  // A_p F_pq with and without occluders, m2
  double visibility = 1.0;
  bool proven = false;  // no occluder is possible: no ray was cast
  std::vector<Ray> rays;
  std::string sentence;
};

// One iteration of B <- E + rho H(B). All values in W/m2, by node.
struct Iteration {
  std::vector<double> sent;      // B, pulled up to the inner nodes
  std::vector<double> gathered;  // irradiance over the node's own links
  std::vector<double> arrived;   // `gathered` plus what was pushed down from the ancestors
  std::vector<double> mean;      // mean of the irradiance of the leaves below
  double residual = 0.0;
};

// A leaf with all vertices on its boundary.
struct LeafLoop {
  std::uint32_t node = radiosity::no_node;
  radiosity::Polygon corners;
  std::vector<int> levels;  // level tags of the vertices
  std::vector<bool> t_vertex;
};

struct Triangulated {
  std::uint32_t node = radiosity::no_node;
  radiosity::Polygon corners;
  std::vector<double> simple, weighted;  // radiosity at the corners
};

struct BfChoice {
  std::uint32_t p = 0, q = 0;  // p = q: the leaf itself
  float error_p = 0.0f, error_q = 0.0f;
  radiosity::Decision decision = radiosity::Decision::link;
  std::string sentence;
};
struct BfGeneration {
  std::size_t nodes = 0, leaves = 0, links = 0;
  double estimate = 0.0;
  std::vector<double> radiosity;
  std::vector<BfChoice> choices;  // sorted by decreasing error
};

// The solvers of solve.hpp on one system, pass by pass: the residual by work, and the radiosities. One pass is as much work as one
// application of all links. Over-shooting is shown too; the library does not have it, because conjugate gradients gain at least as much
// over shooting without it.
struct Method {
  std::string name;
  std::vector<double> residual;                // relative, at the start and after each pass
  std::vector<std::vector<double>> radiosity;  // by node, at the same times
};
struct Comparison {
  double reflectance = 0.0;  // the largest of any surface
  std::vector<Method> methods;
  std::vector<double> solution;
};

struct System {
  radiosity::Transport& transport;
  const std::vector<double>& area;
  std::vector<double> reflectance, emission;  // by input surface
};

inline constexpr unsigned most_passes = 40;

// (solvers.cpp) `keep`: should the radiosities be recorded as well?
[[nodiscard]] Comparison compare_solvers(const System& system, bool keep);

struct Recording {
  std::string scene;
  Wanted wanted;
  radiosity::Hierarchy nodes;  // in the scene's own coordinates, like everything below
  std::vector<std::string> names;
  std::vector<std::uint32_t> born;  // by node: generation of F-refinement in which it was created
  std::vector<radiosity::Polygon> contours;
  std::vector<int> levels;
  std::vector<Pair> pairs;
  std::vector<LinkRecord> links;
  std::size_t too_faint = 0;  // number of pairs that were to be linked but transfer no light
  int channel = 0;
  std::vector<double> emission, reflectance, radiosity;
  std::vector<Iteration> iterations;
  std::vector<LeafLoop> leaves;
  std::vector<Triangulated> mesh;
  radiosity::Hierarchy bf_nodes;
  std::vector<std::string> bf_names;
  std::vector<radiosity::Polygon> bf_contours;
  std::vector<BfGeneration> bf;
  std::optional<double> closure;  // RMS error of the row sums of the form factors before their correction; nothing in an open scene
  Comparison as_is, at_99;        // the solvers on this scene, and with all reflectances that are not 0 set to .99
};

struct RecordResult {
  std::optional<Recording> recording;
  bool invalid = false;                // is the scene invalid, and not just too large?
  std::vector<std::string> sentences;  // why there is no recording
};

[[nodiscard]] RecordResult record(const radiosity::Scene& scene, const std::string& name, const Wanted& wanted);

// --- a recording in words: why a pair was linked or split, what a link carries, what BF-refinement splits; one sentence each, the
// same on the page and in the terminal; the whole as text, and as a page that replays it

[[nodiscard]] std::string number(double x);  // three digits

[[nodiscard]] std::string sentence_of(const Recording& recording, const Pair& pair);
[[nodiscard]] std::string sentence_of(const Recording& recording, const LinkRecord& link);
[[nodiscard]] std::string sentence_of(const Recording& recording, const BfChoice& choice);

// The output of `halflight explain --text`.
[[nodiscard]] std::string story(const Recording& recording);

// The page (page.html, page.css, page.js).
[[nodiscard]] std::string page(const Recording& recording);

}  // namespace apps::explain
