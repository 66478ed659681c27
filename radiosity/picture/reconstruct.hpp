// SPDX-License-Identifier: MIT
#pragma once

// Converts one radiosity per leaf to a mesh with a colour at every corner, for Gouraud shading (paper 4.5). T-vertices are eliminated
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
//   constant  that of face(e) alone: the solution without interpolation
//
// If a leaf has more than 64 times the area of a neighbour, the neighbour's light falls off long before the leaf ends. There w_l
// decreases with the neighbour's exposed area, so that the light of a bright spot or of a sliver is not spread over the whole leaf. The
// angle makes the average independent of how a T-vertex was connected. Ignored are faces of another material, faces buried under another
// object, faces beyond a wall at which a face was cut (wall_cuts.hpp), as far as the wall stands there, and faces behind a lamp at whose
// outline it was cut: a wall or lamp buries nothing, but the light beyond may differ by any factor. A corner with buried faces only takes
// the mean of the other corners of its face. With `constant`, a buried face takes the mean of its weighted corners, because a sliver of
// it may be visible at the foot of the object that buries it.

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

// Connects every T-vertex of the leaves to a corner of its face, except on separate polygons. Returns the number of new faces.
std::uint64_t eliminate_t_vertices(std::vector<Surface>& surfaces);

// The light of the leaves. The references must outlive this.
struct LeafLight {
  const Hierarchy& hierarchy;
  const Exposure& exposure;
  const std::vector<Color>& radiosity;          // by node, W/m2
  const std::vector<std::uint32_t>& materials;  // by input surface
  const raycast::Scene* objects = nullptr;      // if given, colours are not interpolated across the foot of a wall
};

// Sets the half-edge normals and colours of all surfaces and builds the mesh: one face a leaf, positions in the frame. Buried leaves are
// left out, except those that touch an exposed one: a curved object bulges beyond its chords, and the gap between them must not be a
// hole. Of coincident flat leaves only the visible one is in the mesh: a lamp, not the ceiling under it.
Mesh reconstruct(std::vector<Surface>& surfaces, const LeafLight& light, Reconstruction kind);

// As above with other colours and exposed faces: colour(o) sets the colours of the half-edges of surface o, whose normals are already
// set; exposed(o, f) is called for faces with a leaf.
Mesh read_mesh(std::vector<Surface>& surfaces, const LeafLight& light, const std::function<bool(std::size_t, brep::FaceId)>& exposed,
               const std::function<void(std::size_t)>& colour);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/reconstruct.cpp>
#endif
