// SPDX-License-Identifier: MIT
#include <radiosity/refinement/closed_nodes.hpp>

#include <cstddef>
#include <vector>

#include <raycast/inline.hpp>

#include <radiosity/refinement/lamp_choice.hpp>

namespace radiosity {

HALFLIGHT_INLINE ClosedNodes closed_nodes(const DiscreteScene& scene) {
  ClosedNodes closed{std::vector<bool>(scene.hierarchy.size(), false), {}};
  if (!scene.any_closed()) { return closed; }
  for (std::size_t i = 0; i < closed.nodes.size(); ++i) { closed.nodes[i] = scene.loses_nothing(i); }
  closed.lamps = lamp_nodes(scene);
  return closed;
}

}  // namespace radiosity
