// SPDX-License-Identifier: MIT
#pragma once

// What is known of the occlusion of pairs of nodes. The first pair that is looked at gets a list of the shapes that can stand between
// its patches; pairs of descendants inherit the list and only filter it (raycast/shaft.hpp). Two outcomes end the search for the whole
// subtree: nothing can stand in between, or one convex object hides everything.
//
// Lists are kept in one array, a word and the shapes each; a list from which nothing was filtered is that of its parent.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <raycast/shaft.hpp>

#include <radiosity/bend.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/patch.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

// The patches of all nodes, made once a node: the corners of a node never change.
class Patches {
 public:
  // The references must outlive the patches; the hierarchy may grow between two calls of extend().
  Patches(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy) : surfaces_{&surfaces}, hierarchy_{&hierarchy} {}

  void extend(unsigned threads) {
    const std::size_t first = patches_.size();
    patches_.resize(hierarchy_->size());
    parallel_for(patches_.size() - first, threads, [&](std::size_t i) {
      const auto index = static_cast<std::uint32_t>(first + i);
      const Node& node = (*hierarchy_)[index];
      if (node.is_cluster()) { return; }  // no patch
      std::vector<Polygon> parts;
      if (node.in_parts()) {
        for (std::uint32_t k = 0; k < node.child_count; ++k) { parts.push_back(contour(*surfaces_, *hierarchy_, node.first_child + k)); }
      }
      Patch& patch = patches_[index] = make_patch(contour(*surfaces_, *hierarchy_, index), std::move(parts));
      const Surface& surface = (*surfaces_)[node.object];
      if (!(node.deviation > 0.0) || surface.topology == Topology::separate) { return; }
      patch.bent = true;
      patch.bend = bend_of(*surface.object, node.surface - surface.first_surface, patch);
    });
  }
  [[nodiscard]] const Patch& operator[](std::size_t i) const { return patches_[i]; }

  [[nodiscard]] bool is_cluster(std::uint32_t i) const { return (*hierarchy_)[i].is_cluster(); }
  [[nodiscard]] bool is_curved(std::uint32_t i) const { return (*hierarchy_)[i].deviation > 0.0; }

  // The patch as the occluder lists see it. Its descendants leave its plane by at most the tilt of the true surface over its radius.
  [[nodiscard]] raycast::PatchShape shape(std::uint32_t i) const {
    const Node& node = (*hierarchy_)[i];
    return {patches_[i].contour, node.object, node.radius * node.deviation};
  }

 private:
  const std::vector<Surface>* surfaces_;
  const Hierarchy* hierarchy_;
  std::vector<Patch> patches_;
};

class OccluderLists {
 public:
  // Indices that stand for no list: none has been made, or it was too long to keep; nothing stands between; proven to exchange nothing, and
  // linked all the same.
  static constexpr std::uint32_t none = 0xffffffff, clear = 0xfffffffe, hidden = 0xfffffffd;

  [[nodiscard]] raycast::OccluderList operator[](std::uint32_t index) const {
    if (index == none || index == hidden) { return {}; }
    if (index == clear) { return raycast::OccluderList::nothing(); }
    const std::uint32_t head = words_[index];
    return {std::span{words_}.subspan(index + 1, head >> 1), (head & 1u) != 0};
  }

  // The list of a pair of nodes; `ancestors` is the index of a pair of their ancestors. Of clusters nothing is known.
  [[nodiscard]] raycast::OccluderList of(std::uint32_t p, std::uint32_t q, std::uint32_t ancestors, const raycast::Scene& scene,
                                         const Plan& plan, const Patches& patches) const {
    if (patches.is_cluster(p) || patches.is_cluster(q)) { return {}; }
    if (ancestors != none && ancestors != hidden) { return scene.filter((*this)[ancestors], patches.shape(p), patches.shape(q)); }
    const raycast::OccluderList all = scene.occluders(patches.shape(p), patches.shape(q));
    if (!all.known() || all.blocked()) { return all; }
    std::array<std::uint32_t, raycast::OccluderList::capacity> shapes{};
    const auto end = std::copy_if(all.shapes().begin(), all.shapes().end(), shapes.begin(),
                                  [&](std::uint32_t shape) { return !plan.outer[scene.object_of(shape)]; });
    return {std::span<const std::uint32_t>{shapes.begin(), end}, all.rooms_clear()};
  }

  // Keeps a list that `of` gave for these ancestors. Requires that not everything is blocked.
  [[nodiscard]] std::uint32_t keep(const raycast::OccluderList& list, std::uint32_t ancestors) {
    if (list.clear()) { return clear; }
    if (!list.known()) { return none; }
    const auto count = static_cast<std::uint32_t>(list.shapes().size());
    const std::uint32_t head = count << 1 | static_cast<std::uint32_t>(list.rooms_clear());
    if (ancestors < hidden && words_[ancestors] == head) { return ancestors; }
    const auto index = static_cast<std::uint32_t>(words_.size());
    words_.push_back(head);
    words_.insert(words_.end(), list.shapes().begin(), list.shapes().end());
    return index;
  }

  [[nodiscard]] std::size_t bytes() const { return words_.capacity() * sizeof(std::uint32_t); }

 private:
  std::vector<std::uint32_t> words_;  // of each list: twice its length, plus 1 when no room is in the way; then the shapes
};

}  // namespace radiosity
