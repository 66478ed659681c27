// SPDX-License-Identifier: MIT
#pragma once

// A solution as it came about, small enough to be looked at whole: every pair that the oracles were asked about and why it was linked or
// split (paper 4.3, 4.4), the rays of every link, what gather, push and pull do in each iteration, T-vertices, BF-refinement generation by
// generation, and the solvers side by side. Page and text tell what is recorded here and compute nothing.
//
// The stages of a run (radiosity/run/stages.hpp) do the work; refinement is watched through Control::decided.

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
  std::optional<double> light_epsilon;  // default: epsilon, so that the form factor has the first word
  double target = 0.1;                  // of BF-refinement
};

// What one can look at whole. A scene that needs more is refused, with the number and what to do.
inline constexpr std::size_t most_faces = 256, most_nodes = 3000, most_pairs = 12000;

inline constexpr std::uint32_t none = 0xffffffff;

struct Pair {
  std::uint32_t p = 0, q = 0;
  std::uint32_t parent = none;  // the pair whose split opened this one
  std::uint32_t generation = 0;
  double estimate = 0.0;  // the larger of both disk estimates, paper 4.3
  radiosity::Decision by_form_factor = radiosity::Decision::link;
  radiosity::Decision decision = radiosity::Decision::link;
  bool by_light = false;  // it was a link until the light that this carried was known
  std::string sentence;
};

struct Ray {
  glm::dvec3 from{0.0}, to{0.0};
  bool arrives = false;
};

struct LinkRecord {
  std::uint32_t p = 0, q = 0;
  double exchange = 0.0, unoccluded = 0.0;  // A_p F_pq with and without what stands between, m2
  double visibility = 1.0;
  bool proven = false;  // nothing can stand between: no ray was cast
  std::vector<Ray> rays;
  std::string sentence;
};

// One iteration of B <- E + rho H(B). All W/m2, one a node.
struct Iteration {
  std::vector<double> sent;      // B: pulled up to the inner nodes
  std::vector<double> gathered;  // irradiance over the node's own links
  std::vector<double> arrived;   // the same with what was pushed down from above
  std::vector<double> mean;      // of the irradiance of the leaves below
  double residual = 0.0;
};

// A leaf with all vertices on its loop.
struct LeafLoop {
  std::uint32_t node = none;
  radiosity::Polygon corners;
  std::vector<int> levels;  // tags of the vertices
  std::vector<bool> t_vertex;
};

struct Triangulated {
  std::uint32_t node = none;
  radiosity::Polygon corners;
  std::vector<double> simple, weighted;  // radiosity at the corners
};

struct BfChoice {
  std::uint32_t p = 0, q = 0;  // equal: a leaf by itself
  float error_p = 0.0f, error_q = 0.0f;
  radiosity::Decision decision = radiosity::Decision::link;
  std::string sentence;
};
struct BfGeneration {
  std::size_t nodes = 0, leaves = 0, links = 0;
  double estimate = 0.0;
  std::vector<double> radiosity;
  std::vector<BfChoice> choices;  // largest error first
};

// The solvers of solve.hpp on one system, pass by pass: residual against work, and the radiosities on the way. One pass is the work of
// one application of all links. Over-shooting stands beside them: it is not among the library's solvers, for what it gains on shooting
// conjugate gradients gain without it.
struct Method {
  std::string name;
  std::vector<double> residual;                // relative, at the start and after each pass
  std::vector<std::vector<double>> radiosity;  // of each node at the same moments
};
struct Comparison {
  double reflectance = 0.0;  // the greatest
  std::vector<Method> methods;
  std::vector<double> solution;
};

struct System {
  radiosity::Transport& transport;
  const std::vector<double>& area;
  std::vector<double> reflectance, emission;  // one an input surface
};

inline constexpr unsigned most_passes = 40;

// (solvers.cpp) `keep`: the radiosities are kept, too.
[[nodiscard]] Comparison compare_solvers(const System& system, bool keep);

struct Recording {
  std::string scene;
  Wanted wanted;
  radiosity::Hierarchy nodes;  // in the scene's own coordinates, as all that follows
  std::vector<std::string> names;
  std::vector<std::uint32_t> born;  // generation of F-refinement in which the node appears
  std::vector<radiosity::Polygon> contours;
  std::vector<int> levels;
  std::vector<Pair> pairs;
  std::vector<LinkRecord> links;
  std::size_t too_faint = 0;  // pairs that were to be linked, but nothing arrives
  int channel = 0;
  std::vector<double> emission, reflectance, radiosity;
  std::vector<Iteration> iterations;
  std::vector<LeafLoop> leaves;
  std::vector<Triangulated> mesh;
  radiosity::Hierarchy bf_nodes;
  std::vector<std::string> bf_names;
  std::vector<radiosity::Polygon> bf_contours;
  std::vector<BfGeneration> bf;
  std::optional<double> closure;  // RMS by which form factors of a patch did not sum to 1 before that was mended; nothing in an open scene
  Comparison as_is, at_99;        // the solvers on this scene, and with all that reflects at .99
};

struct RecordResult {
  std::optional<Recording> recording;
  bool invalid = false;                // the scene is at fault, not its size
  std::vector<std::string> sentences;  // why there is none
};

[[nodiscard]] RecordResult record(const radiosity::Scene& scene, const std::string& name, const Wanted& wanted);

// --- a recording in words: why a pair was linked or split, what a link carries, what BF-refinement splits; one sentence each, the same on
// the page and in the terminal. And the whole as text, and as a page that replays it.

[[nodiscard]] std::string number(double x);  // three digits

[[nodiscard]] std::string sentence_of(const Recording& recording, const Pair& pair);
[[nodiscard]] std::string sentence_of(const Recording& recording, const LinkRecord& link);
[[nodiscard]] std::string sentence_of(const Recording& recording, const BfChoice& choice);

// `halflight explain --text`.
[[nodiscard]] std::string story(const Recording& recording);

// The page (page.html, page.css, page.js).
[[nodiscard]] std::string page(const Recording& recording);

}  // namespace apps::explain
