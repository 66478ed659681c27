// SPDX-License-Identifier: MIT
#pragma once

// Adapts links when leaves below them are split after their evaluation: they need gradients, because a leaf that becomes an inner node
// passes its light down (links.hpp), and on curved objects exchanges that match the areas, which are more accurate for finer leaves.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

// Sets the gradients of each link between two patches that were leaves when it was made, if one of these is marked, and then calls
// set(link index, doubt); doubt: the variation over the children of either end that the gradients cannot express. `marked` and `leaf`: by
// node; nodes split since the links were made still count as leaves in `leaf`. After cancellation the remaining links are left unchanged.
template <class Set>
void set_gradients_at(const DiscreteScene& scene, Links& links, const std::vector<char>& marked, const std::vector<char>& leaf,
                      const Set& set) {
  const std::vector<double>& area = scene.exposure.area;
  std::vector<std::size_t> touched;
  std::vector<Doubt> doubts;
  in_batches(scene.control, links.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
    touched.clear();
    for (std::size_t k = first; k < last; ++k) {
      const Link& link = links[k];
      if ((marked[link.p] != 0 || marked[link.q] != 0) && leaf[link.p] != 0 && leaf[link.q] != 0) { touched.push_back(k); }
    }
    doubts.assign(touched.size(), {});
    parallel_for(touched.size(), scene.threads, [&](std::size_t k) {
      Link& link = links[touched[k]];
      const Variations light = variations(scene.patches[link.p], scene.patches[link.q]);
      set_gradients(link, light);
      doubts[k].p = static_cast<float>(static_cast<double>(link.exchange) * light.p.rest / area[link.p]);
      doubts[k].q = static_cast<float>(static_cast<double>(link.exchange) * light.q.rest / area[link.q]);
    });
    for (std::size_t k = 0; k < touched.size(); ++k) { set(touched[k], doubts[k]); }
  });
}

// Scales the links as if they had been evaluated with the current areas, which for curved leaves are sums over their children. `before`:
// the areas at the time of evaluation.
void fit_links(DiscreteScene& scene, Links& links, const std::vector<double>& before);

// Does a leaf of a curved object have an edge with an angle below 90 degrees, like a blade? A new vertex there would lie off the edge of
// the leaf on the other side, which may stay unsplit in the dark, and a mesh face between the two would show the wrong side.
[[nodiscard]] bool at_blade(const DiscreteScene& scene, std::uint32_t leaf);

// Weighted area of the lit faces (lit_faces.hpp) that are not buried, in squared units of the frame.
[[nodiscard]] double lit_area(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_fitting.cpp>
#endif
