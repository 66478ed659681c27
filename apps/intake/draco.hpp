// SPDX-License-Identifier: MIT
#pragma once

// Meshes compressed by Draco (https://google.github.io/draco/spec, bitstream 2.2, the one that glTF allows): sequential and Edgebreaker
// connectivity. Damaged streams are refused: all reads stay inside of the bytes, and the memory is bounded by that of a million triangles
// and a multiple of the bytes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace apps::intake::draco {

struct Attribute {
  std::uint32_t unique_id;
  std::size_t components;
  bool integers;               // not floating point numbers, nor integers that the stream itself scales to [-1, 1]
  std::vector<double> values;  // `components` for each point; empty for normals, which are not decoded
};

// A point is what glTF calls a vertex: a corner of triangles with one value of each attribute.
struct Mesh {
  std::size_t points = 0;
  std::vector<std::uint32_t> corners;  // points, three for each triangle
  std::vector<Attribute> attributes;
};

// Nothing if the stream is damaged or of another kind; then `fault` says what is wrong, and at which byte.
[[nodiscard]] std::optional<Mesh> read_mesh(std::string_view bytes, std::string& fault);

}  // namespace apps::intake::draco
