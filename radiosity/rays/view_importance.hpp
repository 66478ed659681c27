// SPDX-License-Identifier: MIT
#pragma once

// What matters for the picture of one camera (importance; Smits, Arvo and Salesin 1992). An error over all surfaces is relative to the
// brightest of them: to a meadow under the sky, say, while the camera stands in a dim room behind a window. So an error counts by its area,
// or by its part of the picture where that is more.
//
// The part of the picture that a node has is what the camera sees of it, and what the light that it sends adds to what the camera sees:
// the mean of the two, for a gathered picture takes its indirect light from the latter.

#include <vector>

#include <radiosity/rays/senders.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct ViewImportance {
  std::vector<double> brightness;  // of each node, as in a coarse solution; lamps count as dark
  double reflected = 0.0;          // RMS over the area of what is reflected
  double pictured = 0.0;           // RMS over the picture of the same
  std::vector<double> weight;      // of each node: how many times more the square of its error counts than by its area; at least 1
};

// By what casters see. `direct`: what each node shows but for light that was reflected more than once. Where the camera sees nothing that
// reflects light, all weights are 1.
[[nodiscard]] ViewImportance view_importance(const DiscreteScene& scene, const std::vector<CasterView>& views,
                                             const std::vector<double>& direct, const Viewpoint& from);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/view_importance.cpp>
#endif
