// SPDX-License-Identifier: MIT
#pragma once

// How bright the light is that surfaces reflect for the first time, before anything is solved: some rays at points spread evenly over the
// surfaces, and at those that rays from the lamps meet. The former find what a far lamp lights of a large scene, the latter a bright spot
// before a near one; each misses what the other finds, so the larger is taken.
//
// Errors are relative to the reflected light. As a rule it is about as bright as the light of the lamps would be if it were spread over all
// surfaces; where most of it gets lost (a sun before a window, a lamp under the open sky) or the surfaces are dark, it may be a thousandth
// of that.

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// Its RMS radiosity over the area of the lit faces (lit_faces.hpp), relative to the mean emission, each in its brightest channel, to some
// 10 %: by 256 points and 256 rays or more, where little is lit by up to 16384 of each. Where none of them finds light, 1. Patches of all
// input faces must be there.
[[nodiscard]] double reflected_light(const DiscreteScene& scene, const PathTracer& tracer);

// The mean of the same light in place of its RMS, to some 3 %, by 1024 rays from the lamps: what bright spots beside lamps hardly raise.
[[nodiscard]] double mean_reflected_light(const DiscreteScene& scene, const PathTracer& tracer);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/reflected_light.cpp>
#endif
