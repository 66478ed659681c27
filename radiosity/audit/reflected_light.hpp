// SPDX-License-Identifier: MIT
#pragma once

// Estimates, before anything is solved, how bright the light is that surfaces reflect once. Rays are cast at points spread uniformly over
// the surfaces, and at points where rays from the lamps arrive. The former find what a distant lamp lights in a large scene, the latter a
// bright spot near a lamp. Each misses what the other finds, so the larger estimate is taken.
//
// Errors are relative to the reflected light. It is usually about as bright as the emitted light would be if spread over all surfaces.
// Where most of that is lost (a sun outside a window, a lamp under the open sky) or the surfaces are dark, it may be a thousandth of that.

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// The RMS radiosity of the light reflected once, over the area of the lit faces (lit_faces.hpp), divided by the mean emission per area,
// each in its brightest channel. Accurate to some 10 %, by at least 256 points and 256 rays, and up to 16384 of each where little is lit.
// Returns 1 if no light is found. The patches of all input faces must exist.
[[nodiscard]] double reflected_light(const DiscreteScene& scene, const PathTracer& tracer);

// As above, but the mean instead of the RMS, to some 3 %, by 1024 rays from the lamps. Bright spots beside lamps hardly raise it.
[[nodiscard]] double mean_reflected_light(const DiscreteScene& scene, const PathTracer& tracer);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/reflected_light.cpp>
#endif
