// SPDX-License-Identifier: MIT
#pragma once

// One shell as a plane map: the shell itself if it has no handles, else the shell with some edges cut open (paper 2.1, fig. 1).
//
// An edge that is cut open becomes two stubs, one at each end, which take its place in the cyclic order around its two vertices. A stub
// is a spur: it ends in a tip that is not a vertex of the shell. Which edges are cut: edges are added one by one, first those that were
// whole in the previous picture, then older before younger ones; an edge that would join two faces of the same connected component (and
// so create a handle) is cut. So if a new bridge creates a handle, the bridge is cut, and the rest of the picture remains as it was.

#include <cstdint>
#include <vector>

#include <brep/handles.hpp>

#include "apps/euler/records.hpp"

namespace apps::euler {

struct PlanarMap {
  // Darts 2i and 2i + 1 are the two directions of edge i. A dart has its face on the left.
  struct Dart {
    std::uint32_t next = 0;
    std::uint32_t vertex = 0;     // its origin; an index of `vertices`
    std::uint32_t face = 0;       // an index of `faces`
    std::uint32_t halfedge = 0;   // the half-edge it represents; both stubs of an edge have darts of both half-edges
    std::uint32_t true_face = 0;  // the face of the shell on its left
  };
  struct Edge {
    std::uint32_t edge = 0;  // index of the edge in the shell
    bool stub = false;       // dart 2i leaves the vertex, dart 2i + 1 the tip
  };
  std::vector<Dart> darts;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertices;            // indices in the shell; brep::invalid_index for the tip of a stub
  std::vector<std::vector<std::uint32_t>> faces;  // the darts around each face of the plane map, in order
};

// The half-edges of each shell; shells in the order of their first half-edge.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> shells_of(const Records& records);

// The map of one shell. `was_cut`: a flag by edge index of the previous picture (may be shorter).
[[nodiscard]] PlanarMap planar_map(const Records& records, const std::vector<std::uint32_t>& shell, const std::vector<bool>& was_cut);

}  // namespace apps::euler
