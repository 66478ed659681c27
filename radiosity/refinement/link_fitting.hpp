// SPDX-License-Identifier: MIT
#pragma once

// What links need when leaves are split below them once they are evaluated: gradients, because a leaf that becomes an inner node hands its
// light down (links.hpp), and on curved objects exchanges that fit the areas, which are known better from finer leaves.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

// Calls set(link index, doubt) for each link between two patches that were leaves when it was made, where one of these is marked, after it
// got its gradients: what the gradients cannot express over the children of either end. Of `marked` and `leaf` there is one a node; leaves
// that were split since then are still called so by `leaf`. A run that is cancelled leaves the rest of the links without.
template <class Set>
void set_gradients_at(const DiscreteScene& scene, Links& links, const std::vector<char>& marked, const std::vector<char>& leaf,
                      const Set& set) {
  constexpr std::size_t batch = 1 << 15;
  const std::vector<double>& area = scene.exposure.area;
  std::vector<std::size_t> touched;
  std::vector<Doubt> doubts;
  for (std::size_t first = 0; first < links.size() && !scene.control.cancelled(); first += batch) {
    touched.clear();
    for (std::size_t k = first; k < std::min(links.size(), first + batch); ++k) {
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
  }
}

// Fits the links as if they had been evaluated with the areas of now: those of curved leaves are sums over their children. `before`: areas
// when they were evaluated.
void fit_links(DiscreteScene& scene, Links& links, const std::vector<double>& before);

// Has a leaf of a curved object an edge sharper than a right angle, as a blade has? A new vertex there lies off the edge of the leaf on
// the other side, which stays whole where it is dark, and a face of the mesh between the two would show the wrong side.
[[nodiscard]] bool at_blade(const DiscreteScene& scene, std::uint32_t leaf);

// Area of the lit faces (lit_faces.hpp) that are not buried, in the squared unit of the frame.
[[nodiscard]] double lit_area(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_fitting.cpp>
#endif
