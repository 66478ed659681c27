// SPDX-License-Identifier: MIT
#pragma once

// Values of an attribute are stored as differences from what the values before them predict (specification, Prediction Decoder).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/intake/draco_corners.hpp"
#include "apps/intake/stream_bytes.hpp"

namespace apps::intake::draco {

// The mesh around the entries of an attribute. `positions`: three integers for each entry of this attribute's vertices; empty if they were
// not read before.
struct Surroundings {
  const CornerTable& table;
  const Sequence& sequence;
  std::vector<std::int32_t> positions;
};

enum class Prediction : std::int8_t {
  none = -2,
  difference = 0,
  parallelogram = 1,
  constrained_multi_parallelogram = 4,
  texture_coordinates = 5,
  geometric_normal = 6,
};

// Reads what the prediction needs, then replaces differences by values, in place. `around`: null for sequential meshes.
void undo_prediction(StreamBytes& in, Prediction prediction, const Surroundings* around, std::size_t components,
                     std::vector<std::int32_t>& values);

// Passes over what belongs to predicted normals.
void skip_normal_prediction(StreamBytes& in, Prediction prediction);

}  // namespace apps::intake::draco
