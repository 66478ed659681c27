// SPDX-License-Identifier: MIT
#pragma once

// From one radiosity a leaf to a mesh with a colour at every corner, for Gouraud shading (paper 4.5). T-vertices are eliminated
// first, so that neighbouring triangles share their corners. The colour at the origin of half-edge e is
//
//      B_e = sum_l w_l B_face(l) / sum_l w_l        over all half-edges l that leave the same vertex,
//
//   simple    w_l = angle of face(l) at the vertex
//   weighted  w_l = angle * max(0, N_e . N_l)^64, after the paper's fig. 5: smooth over a curved surface, and no bleeding
//             over the edge of a box. N is the normal of the true surface there, stored in the half-edge. The paper has the
//             cosine itself, which is the same on curved surfaces and at right angles. Over the edges between the facets of
//             a mesh light changes as much as their normals do: with the cosine, a model of 1000 triangles had 2.8 % error,
//             with its 64th power below 0.9 %, and a terrain 10.8 and 6 %.
//   constant  that of face(e) alone: the solution as it is
//
// Over a leaf with more than 64 times the area of a neighbour, the neighbour's light falls off long before the leaf ends: there w_l falls
// with the neighbour's exposed area, else a bright spot beside it, or what a sliver without width says, would be spread over all of it.
// The angle makes the average independent of how a T-vertex was connected. Faces of another material, and faces that are buried under another
// object, do not count, nor do those beyond a wall that a face was cut at (wall_cuts.hpp), as far as it stands there, or behind a lamp at
// whose outline it was cut: neither buries anything, and light may differ by any factor beyond. A corner with buried faces alone takes the
// mean of its face's others.
// Constant, a buried face takes the mean of its weighted corners: a sliver of it may show at the foot of what buries it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <brep/handles.hpp>

#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

// Connects every T-vertex of the leaves to a corner of its face, except for separate polygons. Returns the number of new faces.
std::uint64_t eliminate_t_vertices(std::vector<Surface>& surfaces);

// The light of the leaves. The references must outlive it.
struct LeafLight {
  const Hierarchy& hierarchy;
  const Exposure& exposure;
  const std::vector<Color>& radiosity;          // of each node, W/m2
  const std::vector<std::uint32_t>& materials;  // of each input surface
  const raycast::Scene* objects = nullptr;      // with them, no colour runs across the foot of a wall
};

// Fills the half-edge normals and colours of all surfaces and reads the mesh from them: one face a leaf, positions in the frame. Buried
// leaves are left out of the mesh, but for those that touch an exposed one: a curved object stands in front of its chords, and what shows
// between the two must not be a hole. Of flat ones that lie on each other only the one that is seen is there: a lamp, not the ceiling under
// it.
Mesh reconstruct(std::vector<Surface>& surfaces, const LeafLight& light, Reconstruction kind);

// The same with colours and exposed faces by others: `colour(o)` gives the half-edges of surface o their colours, whose normals are known
// then; `exposed(o, f)` is asked for faces with a leaf.
Mesh read_mesh(std::vector<Surface>& surfaces, const LeafLight& light, const std::function<bool(std::size_t, brep::FaceId)>& exposed,
               const std::function<void(std::size_t)>& colour);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/reconstruct.cpp>
#endif
