// SPDX-License-Identifier: MIT
#pragma once

// The paper's figures 1 to 8, made anew from scripts and scenes of examples/: drawn as SVG, and a page with all of them and what they show.

#include <string>
#include <vector>

#include <radiosity/run/run.hpp>

#include "apps/study/drawing.hpp"

namespace apps::figures {

struct Figure {
  std::string file;     // figure1.svg
  std::string source;   // in examples/
  std::string caption;  // in our words
  std::string svg;
};

// All eight; a few seconds of CPU time, for figures 6 to 8 are rendered.
[[nodiscard]] std::vector<Figure> make();

[[nodiscard]] std::string page(const std::vector<Figure>& figures);

// Solves up to the reconstruction; false when there is no solution.
[[nodiscard]] bool solve(radiosity::detail::Run& run);

// --- one each; the others are drawn by the stepper
[[nodiscard]] study::Drawing hierarchy_over_faces(const std::string& scene);  // figure 3
[[nodiscard]] study::Drawing level_tags(const std::string& scene);            // figure 4
[[nodiscard]] study::Drawing weights_at_a_rim(const std::string& scene);      // figure 5
// Figures 6 to 8: one solution, reconstructed simply and with weights; the bytes of two PNGs of this size.
struct Pictures {
  std::string simple, weighted;
};
[[nodiscard]] Pictures both_reconstructions(const std::string& scene, unsigned width, unsigned height, double epsilon);

}  // namespace apps::figures
