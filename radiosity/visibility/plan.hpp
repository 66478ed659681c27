// SPDX-License-Identifier: MIT
#pragma once

// Plans the shortcuts of a run: what this scene does not need. The plan is made before other work, from proofs about the objects alone,
// up to the slack that each states; what it leaves out cannot change the result. Each shortcut says what was left out, why and, after the
// run, what it saved.
//
// Without shortcuts everything is done, so that the proofs can be tested: the result is the same, bit for bit, unless a segment passes an
// object within the tolerance of occlusion (raycast/scene.hpp). A pair of patches that would be dropped because no light can pass is
// linked, and the link must turn out to carry nothing; a segment that nothing can block is tested against the whole scene. Patches of one
// curved convex solid are not linked even then: no two points of the solid see each other, but chord patches do, a little, where the mesh
// has a reflex edge.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>

namespace radiosity {

// A closed scene with a reflectance above 1 - 1 / most_bounces is not path-traced: it would take too long, and ending paths earlier would
// make their variance infinite. In a scene that is not proven closed most paths leave; those that do not are ended after this length on
// average, so that a white room made of polygons ends, too.
inline constexpr double most_bounces = 1000.0;

struct Plan {
  bool shortcuts = true;
  bool lit = false;             // does something emit?
  bool reflects = false;        // does something reflect?
  unsigned channels = 3;        // 1 if every material is grey
  bool closed = false;          // is it proven that no light leaves the scene?
  bool traceable = true;        // do paths end soon enough to measure the error?
  bool lossless = false;        // closed, lit, and no absorption in some lit channel: there is no steady state
  std::uint32_t occluders = 0;  // number of objects that can stand between two patches
  std::vector<bool> outer;      // by object: the whole scene lies on one side of it, so it blocks nothing
  std::vector<LeftOut> left_out;
};

// `surfaces`: the unrefined boundaries of the compiled objects, one per object, in the frame.
[[nodiscard]] Plan make_plan(const Scene& scene, const std::vector<Surface>& surfaces, bool shortcuts);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/plan.cpp>
#endif
