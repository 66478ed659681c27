// SPDX-License-Identifier: MIT
#pragma once

// What is known about the occlusion of pairs of nodes. The first pair examined gets a list of the shapes that can stand between its
// patches; pairs of descendants inherit the list and only filter it (raycast/shaft.hpp). Two outcomes end the search for the whole
// subtree: nothing can stand in between, or one convex object hides everything.
//
// Lists are stored in one array, a header word and the shapes each; a list from which nothing was filtered is shared with its parent.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/support/big_array.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// The patches of all nodes. Each is made once, because the corners of a node never change.
class Patches {
 public:
  // The references must outlive the patches; the hierarchy may grow between calls of extend().
  Patches(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, std::pmr::memory_resource* arrays = nullptr)
      : surfaces_{&surfaces}, hierarchy_{&hierarchy}, patches_(arrays) {}

  void extend(unsigned threads);
  [[nodiscard]] const Patch& operator[](std::size_t i) const { return patches_[i]; }

  [[nodiscard]] bool is_cluster(std::uint32_t i) const { return (*hierarchy_)[i].is_cluster(); }
  [[nodiscard]] bool is_curved(std::uint32_t i) const { return (*hierarchy_)[i].deviation > 0.0; }

  // The shape of the patch for the occluder lists. Its descendants depart from its plane by at most the tilt of the true surface times
  // its radius, and from its contour by at most the rim of its border.
  [[nodiscard]] raycast::PatchShape shape(std::uint32_t i) const {
    const Node& node = (*hierarchy_)[i];
    return {patches_[i].contour, node.object, node.radius * node.deviation + node.rim,
            node.surface - (*surfaces_)[node.object].first_surface};
  }

 private:
  const std::vector<Surface>* surfaces_;
  const Hierarchy* hierarchy_;
  BigArray<Patch> patches_;
};

class OccluderLists {
 public:
  OccluderLists() = default;
  explicit OccluderLists(std::pmr::memory_resource* arrays) : words_(arrays) {}

  // Indices without a list. none: none was made, or it was too long to keep; clear: nothing stands between; hidden: proven to exchange
  // nothing, but linked all the same.
  static constexpr std::uint32_t none = 0xffffffff, clear = 0xfffffffe, hidden = 0xfffffffd;

  [[nodiscard]] raycast::OccluderList operator[](std::uint32_t index) const;

  // The list of a pair of nodes; `ancestors`: index for a pair of their ancestors. For clusters nothing is known.
  [[nodiscard]] raycast::OccluderList of(std::uint32_t p, std::uint32_t q, std::uint32_t ancestors, const SceneView& scene) const;

  // Stores a list returned by `of` for these ancestors and returns its index. Requires that not everything is blocked.
  [[nodiscard]] std::uint32_t keep(const raycast::OccluderList& list, std::uint32_t ancestors);

  [[nodiscard]] std::size_t bytes() const { return words_.capacity() * sizeof(std::uint32_t); }

 private:
  BigArray<std::uint32_t> words_;  // by list: twice its length, plus 1 if no room is in the way; then the shapes
};

// A pair of nodes between which light may pass. Either it is open whether they are linked, or they will be and the exchange is unknown.
struct NodePair {
  std::uint32_t p = 0, q = 0;
  std::uint32_t list = OccluderLists::none;  // index of the pair's list, or of that of its ancestors
};
using NodePairs = BigArray<NodePair>;

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/occlusion.cpp>
#endif
