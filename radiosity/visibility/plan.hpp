// SPDX-License-Identifier: MIT
#pragma once

// What this scene does not need. The plan is made before work begins, from proofs about the objects alone, up to the slack
// that each names; what it leaves out cannot change the result. Each omission says what, why and, after the run, what it saved.
//
// Without shortcuts all of it is done, so that the proofs can be tested: the result is the same, bit for bit, unless a segment passes
// an object within the tolerance of occlusion (raycast/scene.hpp). A pair of patches that was dropped because no light can pass is
// linked, and the link must be found to carry nothing; a segment that nothing can block is asked of the whole scene. Patches of one
// curved convex solid are not linked: no two points of the solid see each other, but chord patches do, a little, where the mesh has a
// reflex edge.

#include <cstdint>
#include <string>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>

namespace radiosity {

// A closed scene with a reflectance above 1 - 1 / most_bounces is not path-traced: it would take too long, and to end paths earlier
// would make their variance infinite. In a scene not proven closed paths leave; those that do not are ended at this length
// on average, so that a white room pieced together from polygons ends too.
inline constexpr double most_bounces = 1000.0;

struct Plan {
  bool shortcuts = true;
  bool lit = false;             // something emits
  bool reflects = false;        // something reflects
  unsigned channels = 3;        // 1 when every material is grey
  bool closed = false;          // proven: no light leaves the scene
  bool traceable = true;        // paths end soon enough to measure the error
  bool lossless = false;        // closed, lit, and nothing absorbs in some channel that is lit: no steady state
  std::uint32_t occluders = 0;  // objects that can stand between two patches
  std::vector<bool> outer;      // by object: the whole scene lies on one side of it, it blocks nothing
  std::vector<LeftOut> left_out;
};

// `surfaces` are the unrefined boundaries of the compiled objects, one an object, in the frame.
[[nodiscard]] Plan make_plan(const Scene& scene, const std::vector<Surface>& surfaces, bool shortcuts = true);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/plan.cpp>
#endif
