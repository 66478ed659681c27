// SPDX-License-Identifier: MIT
#pragma once

// Faces of one surface that lie partly on each other in one plane, such as two floors that overlap. Which of them is seen is not defined
// within an object, but between objects it is: of two coplanar surfaces the one of the later object (raycast/scene.hpp). So the faces are
// divided into layers, which become objects of their own; smaller faces come in later layers, as with decals (decals.hpp).

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// The layer of each face, from 0 on. Faces of one layer do not overlap in one plane, whatever their orientations, by more than a strip of
// the tolerance of welding. Time: n log n, if few bounding boxes meet.
[[nodiscard]] std::vector<std::uint32_t> layers_of(Working& mesh, std::span<const std::uint32_t> faces);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/layers.cpp>
#endif
