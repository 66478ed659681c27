// SPDX-License-Identifier: MIT
#pragma once

// The meshing strategy: how the face of a leaf is split into the faces of its children. "A face split could result in only two or three
// new faces, depending on the chosen meshing strategy" (paper 3). The default, RegularMeshing, makes one quadrilateral per corner. A
// user-defined strategy (Options::meshing) is a function object, or a split object of the BRep (brep/split_objects.hpp) wrapped in CutBy.
// Its contract:
//
//   - The returned faces cover the old one and are convex. Their level is one more than that of the old face, and no corner has a higher
//     level than its face (brep/refine.hpp). All of them inherit the data of the old face.
//   - It uses Euler operators only, so the BRep stays valid. It passes new vertices to `place`, which moves them onto the object.
//   - It is deterministic: the same face is always split in the same way. It is called from one thread at a time.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

#include <brep/handles.hpp>
#include <brep/split.hpp>
#include <brep/split_objects.hpp>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// The face of a leaf that is to be split.
struct LeafFace {
  Surface& surface;
  brep::FaceId face;

  // Moves a new vertex onto the object, or onto the curve in which two of its sheets meet. Separate polygons (polygons.hpp) stay flat.
  void place(brep::VertexId v) const;
};

struct ChildFaces {
  std::vector<brep::FaceId> faces;  // empty: the face cannot be split, and nothing has changed
  bool one_a_corner = false;        // does child k have corner k of the old face as its corner 0? Further children may follow
};

template <class M>
concept MeshingStrategy = std::copy_constructible<M> && std::is_invocable_r_v<ChildFaces, const M&, const LeafFace&>;

using Meshing = std::function<ChildFaces(const LeafFace&)>;

// Regular refinement by level tags (paper 4.4, fig. 4). A face of many corners is first cut into a ring and the inner polygon.
struct RegularMeshing {
  [[nodiscard]] ChildFaces operator()(const LeafFace& leaf) const;
};
static_assert(MeshingStrategy<RegularMeshing>);

// One cut at the place given by a split object: two children. If the cut ends inside an edge, the neighbour across that edge gets an
// additional corner, at the children's level; its patch does not change.
template <brep::SplitObjectFor<SurfaceBRep> Split>
class CutBy {
 public:
  explicit CutBy(Split split) : split_{std::move(split)} {}

  [[nodiscard]] ChildFaces operator()(const LeafFace& leaf) const {
    SurfaceBRep& brep = leaf.surface.brep;
    const unsigned level = brep.data(leaf.face).level + 1u;
    if (level > 255) { return {}; }
    bool cut = false;
    const auto once = [&](const SurfaceBRep& b, brep::FaceId f) { return std::exchange(cut, true) ? brep::Cut{} : split_(b, f); };
    const auto finished = [&](const SurfaceBRep&, brep::FaceId) { return cut; };
    const auto parts = brep::split_recursively(brep, leaf.face, once, finished);
    if (!parts || parts->faces.size() < 2) { return {}; }
    for (const brep::FaceId f : parts->faces) { brep.data(f).level = static_cast<std::uint8_t>(level); }
    for (const brep::Parts::Step& step : parts->steps) {
      if (step.new_vertex) {
        brep.data(brep.vertex(step.h)).level = static_cast<std::uint8_t>(level);
        leaf.place(brep.vertex(step.h));
      } else {  // the ends of the cut are corners of both children
        for (const brep::VertexId v : {brep.vertex(step.h), brep.target(step.h)}) {
          brep.data(v).level = std::min(brep.data(v).level, static_cast<std::uint8_t>(level));
        }
      }
    }
    return {parts->faces, false};
  }

 private:
  Split split_;
};

// Splits a leaf: the faces made by the strategy become its children. Returns false if there are none, or if the patches of a curved
// object do not get smaller; then nothing has changed.
[[nodiscard]] bool subdivide(std::vector<Surface>& surfaces, Hierarchy& hierarchy, std::uint32_t index,
                             const Meshing& meshing = RegularMeshing{});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/meshing.cpp>
#endif
