// SPDX-License-Identifier: MIT
#include <radiosity/visibility/occlusion.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/bend.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

HALFLIGHT_INLINE void Patches::extend(unsigned threads) {
  const std::size_t first = patches_.size();
  patches_.resize(hierarchy_->size());
  parallel_for(patches_.size() - first, threads, [&](std::size_t i) {
    const auto index = static_cast<std::uint32_t>(first + i);
    const Node& node = (*hierarchy_)[index];
    if (node.is_cluster()) { return; }  // clusters have no patch
    std::vector<Polygon> parts;
    if (node.in_parts()) {
      for (std::uint32_t k = 0; k < node.child_count; ++k) { parts.push_back(contour(*surfaces_, *hierarchy_, node.first_child + k)); }
    }
    Patch& patch = patches_[index] =
        make_patch(contour(*surfaces_, *hierarchy_, index), std::move(parts), patches_.get_allocator().memory());
    const Surface& surface = (*surfaces_)[node.object];
    if (!(node.deviation > 0.0) || surface.topology == Topology::separate) { return; }
    patch.bent = true;
    patch.bend = bend_of(*surface.object, node.surface - surface.first_surface, patch);
  });
}

HALFLIGHT_INLINE raycast::OccluderList OccluderLists::operator[](std::uint32_t index) const {
  if (index == none || index == hidden) { return {}; }
  if (index == clear) { return raycast::OccluderList::nothing(); }
  const std::uint32_t head = words_[index];
  return {std::span{words_}.subspan(index + 1, head >> 1), (head & 1u) != 0};
}

HALFLIGHT_INLINE raycast::OccluderList OccluderLists::of(std::uint32_t p, std::uint32_t q, std::uint32_t ancestors,
                                                         const SceneView& scene) const {
  const Patches& patches = scene.patches;
  if (patches.is_cluster(p) || patches.is_cluster(q)) { return {}; }
  if (ancestors != none && ancestors != hidden) { return scene.objects.filter((*this)[ancestors], patches.shape(p), patches.shape(q)); }
  const raycast::OccluderList all = scene.objects.occluders(patches.shape(p), patches.shape(q));
  if (!all.known() || all.blocked()) { return all; }
  std::array<std::uint32_t, raycast::OccluderList::capacity> shapes{};
  const auto end = std::copy_if(all.shapes().begin(), all.shapes().end(), shapes.begin(),
                                [&](std::uint32_t shape) { return !scene.plan.outer[scene.objects.object_of(shape)]; });
  return {std::span<const std::uint32_t>{shapes.begin(), end}, all.rooms_clear()};
}

HALFLIGHT_INLINE std::uint32_t OccluderLists::keep(const raycast::OccluderList& list, std::uint32_t ancestors) {
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

}  // namespace radiosity
