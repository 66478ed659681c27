// SPDX-License-Identifier: MIT
#pragma once

// A drawing as pixels, without jagged edges: lines by their distance to the pixel's centre, areas by the part of the pixel that they
// cover. Every shape and every label covers a pixel once, whatever number of its strokes pass there.

#include "apps/picture.hpp"
#include "apps/study/drawing.hpp"

namespace study {

// `scale` pixels for each unit of the drawing; opaque, on paper.
[[nodiscard]] apps::Picture rasterize(const Drawing& drawing, double scale);

}  // namespace study
