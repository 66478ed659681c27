// SPDX-License-Identifier: MIT
#pragma once

// Edgebreaker (Rossignac 1999; Isenburg and Snoeyink 2001, Spirale Reversi): the triangles of a mesh from one symbol each. Read backwards,
// as here, each symbol says how a new triangle is glued to the boundary of those that are there.

#include <cstddef>
#include <vector>

#include "apps/intake/draco_corners.hpp"
#include "apps/intake/stream_bytes.hpp"

namespace apps::intake::draco {

// The corner table of the positions and then those of the attributes with seams, in the order of the stream.
// A stream is refused if its triangles times its tables are more than `most`.
[[nodiscard]] std::vector<CornerTable> read_edgebreaker(StreamBytes& in, std::size_t most);

}  // namespace apps::intake::draco
