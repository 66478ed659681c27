// SPDX-License-Identifier: MIT
#pragma once

// Weights for the picture of one camera (importance; Smits, Arvo and Salesin 1992). An error over all surfaces is relative to the
// brightest of them, for instance a meadow under the sky, although the camera stands in a dim room behind a window. So errors are
// weighted by area, or by the share of the picture if that is more.
//
// The share of the picture of a node is the mean of two shares: what the camera sees of it, and the contribution of its light to what the
// camera sees, because a gathered picture takes its indirect light from there: after one reflection, or from behind corners after many.

#include <vector>

#include <radiosity/rays/senders.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct ViewImportance {
  std::vector<double> brightness;  // by node, as in a coarse solution; lamps count as dark
  double reflected = 0.0;          // RMS of the reflected light over the area
  double pictured = 0.0;           // the same over the picture
  std::vector<double> weight;      // by node: factor by which a squared error counts more than by area; at least 1
};

// Computed from what casters see. `direct`: by node, its radiosity without light reflected more than once. If the camera sees nothing
// that reflects light, all weights are 1.
[[nodiscard]] ViewImportance view_importance(const DiscreteScene& scene, const std::vector<CasterView>& views,
                                             const std::vector<double>& direct, const Viewpoint& from);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/view_importance.cpp>
#endif
