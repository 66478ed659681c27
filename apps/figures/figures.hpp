// SPDX-License-Identifier: MIT
#pragma once

// The paper's figures 1 to 8, generated from scripts and scenes of examples/ as SVG, and a page with all of them and captions.

#include <string>
#include <vector>

namespace apps::figures {

struct Figure {
  std::string file;     // figure1.svg
  std::string source;   // in examples/
  std::string caption;  // in our own words
  std::string svg;
};

// All eight; takes a few seconds of CPU time, because figures 6 to 8 are rendered.
[[nodiscard]] std::vector<Figure> make();

[[nodiscard]] std::string page(const std::vector<Figure>& figures);

}  // namespace apps::figures
