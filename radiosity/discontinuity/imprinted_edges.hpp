// SPDX-License-Identifier: MIT
#pragma once

// What discontinuity meshing did, for the report.

#include <cstdint>

namespace radiosity {

struct ImprintedEdges {
  std::uint64_t edges = 0, faces = 0;  // along the edges of shadows; on so many faces
  std::uint64_t limited = 0;           // faces on which no more were allowed
  std::uint64_t not_looked_at = 0;     // faces whose lines were not looked for: too many pairs of faces, lamps and objects
};

}  // namespace radiosity
