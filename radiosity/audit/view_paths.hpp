// SPDX-License-Identifier: MIT
#pragma once

// What a camera sees and where that has its light from, before anything is solved: paths that begin at the eye.

#include <vector>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct ViewPaths {
  // Where paths met fronts, with the part of the picture that they carried there: half of all weight on what is seen, for the mesh may be
  // shown, half on what that is lit by, for a gathered picture takes its indirect light from there.
  std::vector<ImportantPoint> points;
  double reflected = 0.0;  // RMS of the radiosity that is reflected by what is seen, brightest channel: to some tenths
};

// The same for any number of threads. Nothing is seen where there are no points.
[[nodiscard]] ViewPaths view_paths(const DiscreteScene& scene, const PathTracer& tracer, const Viewpoint& from);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/view_paths.cpp>
#endif
