// SPDX-License-Identifier: MIT
#pragma once

// The plots of a study: which curves, of which errors, against which cost.

#include <string>
#include <vector>

#include "apps/study/drawing.hpp"
#include "apps/study/results.hpp"

namespace study {

struct Figure {
  std::string name;     // for the file
  std::string caption;  // one or two sentences
  Drawing drawing;
};

// Error against CPU time, memory and links, and what the reconstructions change. A method has the same colour and mark in all scenes.
[[nodiscard]] std::vector<Figure> figures(const Study& study, const SceneStudy& scene);

}  // namespace study
