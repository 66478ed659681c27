// SPDX-License-Identifier: MIT
#include <radiosity/solver/tree_transport.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

HALFLIGHT_INLINE TreeTransport::TreeTransport(const Transport& transport) : transport_{&transport} {
  const Hierarchy& hierarchy = transport.hierarchy();
  tree_.resize(hierarchy.size());
  std::uint32_t trees = 0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { tree_[i] = hierarchy[i].parent == no_node ? trees++ : tree_[hierarchy[i].parent]; }
  nodes_ = Groups(trees, hierarchy.size(), [&](auto&& add) {
    for (std::uint32_t i = 0; i < hierarchy.size(); ++i) { add(tree_[i], i); }
  });
  for (std::size_t number = 0; number < transport.parts(); ++number) {
    const std::span<const Link> links = transport.links(number);
    Groups groups(trees, 2 * links.size(), [&](auto&& add) {
      for (std::uint32_t i = 0; i < links.size(); ++i) {
        add(tree_[links[i].p], i);
        if (tree_[links[i].q] != tree_[links[i].p]) { add(tree_[links[i].q], i); }
      }
    });
    const std::vector<Transport::Moments> none(hierarchy.size());
    parts_.push_back({std::move(groups), none, none});
  }
}

HALFLIGHT_INLINE void TreeTransport::gather(std::uint32_t tree, std::vector<double>& y) {
  for (std::size_t number = 0; number < parts_.size(); ++number) {
    Part& part = parts_[number];
    for (const std::uint32_t l : part.links[tree]) {
      const Link& link = transport_->links(number)[l];
      const glm::dvec3 at_p = link.shape_p.gradient(), at_q = link.shape_q.gradient();
      if (tree_[link.p] == tree) { Transport::carry(link, part.sent[link.q], part.arrived[link.p], at_q, at_p); }
      if (tree_[link.q] == tree) { Transport::carry(link, part.sent[link.p], part.arrived[link.q], at_p, at_q); }
    }
  }
  collect(tree, y);
}

HALFLIGHT_INLINE void TreeTransport::collect(std::uint32_t tree, std::vector<double>& y) {
  for (const std::uint32_t i : nodes_[tree]) { y[i] = 0.0; }
  for (std::size_t number = 0; number < parts_.size(); ++number) {
    for (const std::uint32_t i : nodes_[tree]) {
      transport_->push(number, i, parts_[number].arrived, y);
      parts_[number].arrived[i] = {};
    }
  }
}

}  // namespace radiosity
