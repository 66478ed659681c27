// SPDX-License-Identifier: MIT
#pragma once

// Traces paths from the eye, before anything is solved, to find what a camera sees and from where that receives its light.

#include <vector>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct ViewPaths {
  // Points where paths met front faces, each with the share of the picture that the path carried there. Half of the total weight lies on
  // what is seen, because the mesh may be shown; half on what lights it, because a gathered picture takes its indirect light from there.
  std::vector<ImportantPoint> points;
  double reflected = 0.0;  // RMS of the reflected radiosity of what is seen, brightest channel; to some tens of percent
};

// The result does not depend on the number of threads. If nothing is seen, there are no points.
[[nodiscard]] ViewPaths view_paths(const DiscreteScene& scene, const PathTracer& tracer, const Viewpoint& from);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/view_paths.cpp>
#endif
