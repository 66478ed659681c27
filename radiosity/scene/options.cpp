// SPDX-License-Identifier: MIT
#include <radiosity/scene/options.hpp>

#include <string>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/support/number_text.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<std::string> faults(const Options& options) {
  std::vector<std::string> sentences;
  const auto check = [&](const char* name, double value, bool sound, const char* range) {
    if (!sound) { sentences.push_back(std::string{name} + " is " + number_text(value) + "; it must be " + range); }
  };
  check("epsilon", options.epsilon, options.epsilon > 0.0, "above 0");
  check("min_area", options.min_area, options.min_area >= 0.0, "0 or more");
  check("target", options.target, options.target > 0.0, "above 0");
  if (options.light_epsilon) { check("light_epsilon", *options.light_epsilon, *options.light_epsilon > 0.0, "above 0"); }
  if (options.time) {
    check("time", *options.time, *options.time > 0.0, "above 0");
    if (options.error) { sentences.emplace_back("a time limit and an error target exclude each other; give one"); }
    if (options.refinement == Refinement::a_priori) {
      sentences.emplace_back("a time limit needs BF-refinement: F-refinement knows no best-first");
    }
  }
  if (options.indirect == Indirect::rays && options.refinement == Refinement::a_posteriori) {
    sentences.emplace_back("light by stored rays needs F-refinement: BF-refinement splits links by what they carry");
  }
  if (options.indirect == Indirect::rays && (options.solver == Solver::gauss_seidel || options.solver == Solver::southwell)) {
    sentences.emplace_back(
        "light by stored rays needs the solver cg or jacobi: Gauss-Seidel and Southwell go through the links of one patch at a time");
  }
  if (options.memory && *options.memory == 0) { sentences.emplace_back("memory is 0; it must be above 0, or be left out for no limit"); }
  if (options.discontinuities > 0 && (options.topology == Topology::separate || options.meshing)) {
    sentences.emplace_back("discontinuity meshing needs faces that share their vertices, and no meshing strategy of its own beside it");
  }
  check("residual", options.residual, options.residual > 0.0, "above 0");
  if (options.error) {
    check("error", *options.error, *options.error > 0.0, "above 0");
    if (options.audit_points == 0) { sentences.emplace_back("an error target needs the audit as its witness; give it some points"); }
  }
  if (options.mesh_error) {
    check("mesh_error", *options.mesh_error, *options.mesh_error > 0.0, "above 0");
    if (options.error) { sentences.emplace_back("an error target and a mesh error exclude each other; give one"); }
    if (options.topology == Topology::separate || options.reconstruction >= Reconstruction::constant) {
      sentences.emplace_back("a mesh error needs faces that share their vertices, and a reconstruction that is weighted or simple");
    }
  }
  return sentences;
}

}  // namespace radiosity
