// SPDX-License-Identifier: MIT
#pragma once

// Which faces hang together. Faces of one shell (working.hpp) that run along an edge in opposite directions are neighbours across it. First
// the faces are turned so that this holds wherever two meet, each component as the larger part of its area looks. Where it cannot hold (a
// Moebius strip), and where more than two faces meet, the surface is cut. But faces that hang together elsewhere, across edges of their
// own, are one piece, and two sides of one piece are neighbours there, too, as those of each of two boxes that touch in an edge. Of an even
// number of other faces, half of them in each direction, those are neighbours that have the solid between them.
//
// Where two fans of faces touch in one vertex each fan gets a vertex of its own, so that afterwards every component is a manifold: a
// boundary with at most one gap at each vertex. Faces for which that is impossible become loose: they have no neighbours.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// The sides of the faces, side s of face f being its corner s - first[f] and the next one.
struct Topology {
  std::vector<std::uint32_t> first;      // side of a face; one more than there are faces
  std::vector<std::uint32_t> mate;       // of a side: the neighbour's, or none
  std::vector<std::uint32_t> vertex;     // of a side: the vertex at its beginning, numbered anew so that each has one fan
  std::vector<std::uint32_t> component;  // of a face
  std::uint32_t vertices = 0, components = 0;

  [[nodiscard]] std::uint32_t next(std::uint32_t side, std::uint32_t face) const {
    return side + 1 == first[face + 1] ? first[face] : side + 1;
  }
};

// Turns faces alike, and numbers the pieces (Face::piece); faces that were given for both sides do not count. Faces of components of which
// more than a tenth of the area had to be turned, or that cannot be turned alike, are marked as mixed: it is not known which side was meant
// to be seen.
void orient(Working& mesh);

// Changes no face. `report`: what had to be cut counts as a change.
[[nodiscard]] Topology topology_of(Working& mesh, bool report);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/topology.cpp>
#endif
