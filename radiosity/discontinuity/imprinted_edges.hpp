// SPDX-License-Identifier: MIT
#pragma once

// Counts of discontinuity meshing, for the report.

#include <cstdint>

namespace radiosity {

struct ImprintedEdges {
  std::uint64_t edges = 0, faces = 0;  // shadow edges imprinted, and the number of faces with some
  std::uint64_t limited = 0;           // faces that reached the limit of edges
  std::uint64_t not_looked_at = 0;     // faces whose lines were not searched: too many combinations of faces, lamps and objects
};

}  // namespace radiosity
