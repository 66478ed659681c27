// SPDX-License-Identifier: MIT
#pragma once

// The paper's figures 1 to 8, made anew from scripts and scenes of examples/: drawn as SVG, and a page with all of them and what they show.

#include <string>
#include <vector>

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

}  // namespace apps::figures
