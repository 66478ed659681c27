// SPDX-License-Identifier: MIT
#pragma once

// Finds which faces are connected. Faces of one shell (working.hpp) that run along an edge in opposite directions are neighbours across
// it. First the faces are turned so that this holds wherever two meet; each component gets the orientation of the larger part of its
// area. Where that is impossible (a Moebius strip), and where more than two faces meet, the surface is cut. There are two exceptions for
// edges with more than two faces. Faces that are connected elsewhere, across edges of their own, form a piece, and two sides of one piece
// are neighbours, for instance where two boxes touch in an edge. If the number of the other faces is even, with half of them in each
// direction, those become neighbours that have the solid between them.
//
// Where two fans of faces touch in one vertex, each fan gets its own vertex, so that every component is a manifold: a boundary with at
// most one gap at each vertex. Faces for which that is impossible become loose: they get no neighbours.

#include <cstdint>
#include <vector>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Side s of face f runs from corner s - first[f] to the next corner.
struct Topology {
  std::vector<std::uint32_t> first;      // by face: its first side; one entry more than there are faces
  std::vector<std::uint32_t> mate;       // by side: the neighbour's side, or none
  std::vector<std::uint32_t> vertex;     // by side: the vertex where it begins, renumbered so that each vertex has a single fan
  std::vector<std::uint32_t> component;  // by face
  std::uint32_t vertices = 0, components = 0;

  [[nodiscard]] std::uint32_t next(std::uint32_t side, std::uint32_t face) const {
    return side + 1 == first[face + 1] ? first[face] : side + 1;
  }
};

// Gives connected faces a consistent orientation and numbers the pieces (Face::piece); faces with polygons for both sides are ignored. If
// more than a tenth of a component's area had to be turned, or a consistent orientation is impossible, its faces are marked as mixed: it
// is not known which side was meant to be seen.
void orient(Working& mesh);

// Changes no face. `report`: counts cuts as changes.
[[nodiscard]] Topology topology_of(Working& mesh, bool report);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/topology.cpp>
#endif
