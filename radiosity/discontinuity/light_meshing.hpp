// SPDX-License-Identifier: MIT
#pragma once

// Discontinuity meshing, hierarchical (Lischinski, Tampieri and Greenberg 1993): the faces of flat objects are cut where the direct light
// is not smooth, from the roots of the hierarchy on, so the pieces are nodes with light of their own and links to any of them.
//
// Each split of a leaf is one cut by Euler operators (CutBy, meshing.hpp), where the light on it varies most (direct_variation.hpp): along
// a critical line that crosses it, or across its light. A leaf is split for its direct light while that varies too much over it. So pieces
// arise where they are worth something, and a line of which nothing is to be seen cuts nothing.
//
// Lamps are those of DirectLight; of those that reflect nothing the radiosity is the same all over, so one link brings the light of the
// whole lamp to any leaf over which it is even, however large its form factor is.

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/discontinuity/direct_variation.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

// The critical lines of all faces.
struct CriticalLines {
  // By the object and the part of its boundary (SurfaceFace::part).
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<CriticalLine>> of;
  std::size_t left_out = 0;  // beyond the limit
};

class LightMeshing {
 public:
  // The surfaces are those before any cut. At most `limit` lines are kept on each face, those of lower degree first.
  LightMeshing(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& reflectance,
               const std::vector<Color>& emission, std::size_t limit);

  [[nodiscard]] const DirectLight& light() const { return light_; }
  [[nodiscard]] const CriticalLines& lines() const { return lines_; }

  // Is this a lamp whose light is looked at, on a receiver for which that is done?
  [[nodiscard]] bool covers(const Node& lamp, const Node& receiver) const;
  // Does the lamp reflect nothing?
  [[nodiscard]] bool even(const Node& lamp) const { return is_black(reflectance_[lamp.surface]); }

  // Looks at the light on these nodes, in parallel.
  void measure(const std::vector<std::uint32_t>& nodes, const Hierarchy& hierarchy, const Patches& patches,
               const std::vector<Surface>& surfaces, unsigned threads);
  [[nodiscard]] bool measured(std::uint32_t node) const { return node < known_.size() && known_[node]; }
  // The variance of the reflected direct light over a node that was measured; in the squared unit of the emission.
  [[nodiscard]] double variance(std::uint32_t node) const { return measured_[node].variance; }

  // The strategy: splits a leaf of a flat object at its best cut, others regularly.
  [[nodiscard]] ChildFaces split(const LeafFace& leaf) const;

 private:
  [[nodiscard]] PatchVariation look_at(const Surface& surface, brep::FaceId face, const Patch& patch) const;

  DirectLight light_;
  CriticalLines lines_;
  std::vector<Color> reflectance_;
  std::vector<std::uint32_t> object_of_;  // by its first input surface
  std::vector<bool> known_;
  std::vector<PatchVariation> measured_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/light_meshing.cpp>
#endif
