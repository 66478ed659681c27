// SPDX-License-Identifier: MIT
#pragma once

// Discontinuity meshing within the hierarchy (Lischinski, Tampieri and Greenberg 1993): the faces of flat objects are cut along the edges
// of shadows, and across their light, from the input faces on. The pieces are nodes of the hierarchy like others.
//
// Each split of a leaf is one cut by Euler operators (CutBy, hierarchy/meshing.hpp), the one that takes most of the variance of its direct
// light away (direct_variation.hpp). A leaf is split for a lamp while that variance is too large a share of the error. So edges are
// imprinted where they are worth it, and a line of which nothing is to be seen cuts nothing.
//
// A lamp that reflects nothing has the same radiosity all over. One link carries the light of the whole of it to any leaf on which that
// light is even, however large its form factor is; neither end needs to be split for it.

#include <cstddef>
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
  // The surfaces are the boundaries before any cut; the scene must outlive this. On each face at most `most_edges` edges are imprinted.
  // Time: pairs of faces, lamps and objects, of which no more than 20 million are looked at.
  LightMeshing(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& reflectance,
               const std::vector<Color>& emission, std::uint32_t most_edges);

  // Is the variance of the light known, or can measure() find it?
  [[nodiscard]] static bool measurable(const Node& node) { return !node.is_cluster() && node.deviation == 0.0 && node.area > 0.0; }
  [[nodiscard]] bool is_lamp(const Node& node) const { return !node.is_cluster() && light_.is_lamp(node.surface); }
  // Is this a lamp with the same radiosity all over? One in parts is not taken for it: a link with many parts costs more than theirs.
  [[nodiscard]] bool is_even_lamp(const Node& node) const {
    return is_lamp(node) && is_black(reflectance_[node.surface]) && !node.in_parts();
  }

  // Measures the light on these nodes, in parallel.
  void measure(const std::vector<std::uint32_t>& nodes, const Hierarchy& hierarchy, const Patches& patches,
               const std::vector<Surface>& surfaces, unsigned threads);
  [[nodiscard]] bool measured(std::uint32_t node) const { return node < measured_.size() && measured_[node].known; }
  // Of a node that was measured.
  [[nodiscard]] const DirectVariation& light_on(std::uint32_t node) const { return measured_[node].variation; }

  // The share of a lamp's light that arrives on a node, where that was measured for the whole lamp; nothing where it was not, or where
  // nothing stands between.
  [[nodiscard]] std::optional<double> seen_share(const Hierarchy& hierarchy, std::uint32_t lamp, std::uint32_t node) const;

  // The meshing strategy. Faces of curved objects are refined regularly.
  [[nodiscard]] ChildFaces split(const LeafFace& leaf);
  // The same for a face that may be a part of that of its leaf.
  [[nodiscard]] ChildFaces split_part(const LeafFace& part);

  [[nodiscard]] ImprintedEdges imprinted() const;

 private:
  // By object and part of its boundary (SurfaceFace::part), which stays the same however that is cut.
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
  std::vector<std::uint32_t> object_of_;  // by the first input surface of each object
  std::uint32_t most_edges_;
  std::uint64_t not_looked_at_ = 0;
  std::map<FaceKey, FaceLines> faces_;
  std::vector<Measured> measured_;  // by node
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/light_meshing.cpp>
#endif
