// SPDX-License-Identifier: MIT
#pragma once

// Discontinuity meshing within the hierarchy (Lischinski, Tampieri and Greenberg 1993): the faces of flat objects are cut along shadow
// edges and across gradients of their light, beginning with the input faces. The pieces are ordinary nodes of the hierarchy.
//
// Each split of a leaf is one cut by Euler operators (CutBy, hierarchy/meshing.hpp): the one that removes most of the variance of the
// leaf's direct light (direct_variation.hpp). A leaf is split for a lamp as long as that variance is too large a share of the error. So
// edges are imprinted only where that pays, and a line without visible effect cuts nothing.
//
// A lamp that reflects nothing has constant radiosity. One link carries the light of the whole lamp to any leaf on which this light is
// nearly constant, however large the form factor is; neither end needs to be split for it.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <brep/handles.hpp>

#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/discontinuity/direct_variation.hpp>
#include <radiosity/discontinuity/imprinted_edges.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

class LightMeshing {
 public:
  // `surfaces`: the boundaries before any cut; `objects` must outlive this. At most `most_edges` edges are imprinted on each face. Cost:
  // combinations of faces, lamps and objects, of which at most 20 million are searched.
  LightMeshing(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& reflectance,
               const std::vector<Color>& emission, std::uint32_t most_edges);

  // Can measure() determine the variance of the light on this node? Not for clusters, curved faces and faces without area.
  [[nodiscard]] static bool measurable(const Node& node) { return !node.is_cluster() && node.deviation == 0.0 && node.area > 0.0; }
  [[nodiscard]] bool is_lamp(const Node& node) const { return !node.is_cluster() && light_.is_lamp(node.surface); }
  // Is this a lamp of constant radiosity? False for an input face in several convex parts, because a link with all of them costs more
  // than links with each.
  [[nodiscard]] bool is_even_lamp(const Node& node) const {
    return is_lamp(node) && is_black(reflectance_[node.surface]) && !node.in_parts();
  }

  // Measures the light on these nodes, in parallel.
  void measure(const std::vector<std::uint32_t>& nodes, const Hierarchy& hierarchy, const Patches& patches,
               const std::vector<Surface>& surfaces, unsigned threads);
  [[nodiscard]] bool measured(std::uint32_t node) const { return node < measured_.size() && measured_[node].known; }
  // The result for a node that was measured.
  [[nodiscard]] const DirectVariation& light_on(std::uint32_t node) const { return measured_[node].variation; }

  // The share of a lamp's light that arrives on a node, if it was measured for the whole lamp; nothing if it was not, or if nothing
  // stands between.
  [[nodiscard]] std::optional<double> seen_share(const Hierarchy& hierarchy, std::uint32_t lamp, std::uint32_t node) const;

  // The meshing strategy: cuts measured flat leaves, and refines all others regularly.
  [[nodiscard]] ChildFaces split(const LeafFace& leaf);
  // The same for a face that may be only a part of its leaf.
  [[nodiscard]] ChildFaces split_part(const LeafFace& part);

  [[nodiscard]] ImprintedEdges imprinted() const;

 private:
  // Object and part of its boundary (SurfaceFace::part); the latter does not change when the boundary is cut.
  using FaceKey = std::pair<std::uint32_t, std::uint32_t>;
  struct FaceLines {
    std::vector<CriticalLine> lines;
    std::uint64_t edges = 0;  // imprinted so far
    bool limited = false;
  };
  struct Measured {
    bool known = false;
    DirectVariation variation;
  };

  void find_lines(const std::vector<Surface>& surfaces);
  [[nodiscard]] FaceKey key(const Surface& surface, brep::FaceId face) const;
  [[nodiscard]] ChildFaces cut(const LeafFace& leaf, const DirectVariation& light);
  [[nodiscard]] DirectVariation look_at(const Surface& surface, brep::FaceId face, const Patch& patch) const;

  DirectLight light_;
  std::vector<Color> reflectance_;        // of each input surface
  std::vector<std::uint32_t> object_of_;  // indexed by the first input surface of each object
  std::uint32_t most_edges_;
  std::uint64_t not_looked_at_ = 0;
  std::map<FaceKey, FaceLines> faces_;
  std::vector<Measured> measured_;  // by node
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/light_meshing.cpp>
#endif
