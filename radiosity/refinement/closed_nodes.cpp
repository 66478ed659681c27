// SPDX-License-Identifier: MIT
#include <radiosity/refinement/closed_nodes.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/refinement/lamp_choice.hpp>

namespace radiosity {

namespace detail {

// Nodes in clusters that have a link and contain a leaf that loses light.
HALFLIGHT_INLINE std::vector<bool> in_open_clusters(const DiscreteScene& scene, const Links& links) {
  const Hierarchy& nodes = scene.hierarchy;
  std::vector<bool> loses(nodes.size(), false), linked(nodes.size(), false);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    loses[i] = loses[i] || (nodes[i].leaf() && scene.exposure.area[i] > 0.0 && !scene.loses_nothing(i));
    if (loses[i] && nodes[i].parent != no_node) { loses[nodes[i].parent] = true; }
  }
  for (const Link& link : links) {
    for (const std::uint32_t end : {link.p, link.q}) { linked[end] = linked[end] || (nodes[end].is_cluster() && loses[end]); }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent != no_node && linked[nodes[i].parent]) { linked[i] = true; }
  }
  return linked;
}

}  // namespace detail

HALFLIGHT_INLINE ClosedNodes closed_nodes(const DiscreteScene& scene, const Links& links) {
  ClosedNodes closed{std::vector<bool>(scene.hierarchy.size(), false), lamp_nodes(scene)};
  if (!scene.any_closed()) { return closed; }
  const std::vector<bool> open = detail::in_open_clusters(scene, links);
  for (std::size_t i = 0; i < closed.nodes.size(); ++i) { closed.nodes[i] = scene.loses_nothing(i) && !open[i]; }
  return closed;
}

}  // namespace radiosity
