// SPDX-License-Identifier: MIT
#pragma once

// The mesh of a solution: one face a leaf, with the colours of its half-edges.
// Buried leaves are left out, but for those that touch an exposed one: a curved object stands in front of its chords, and what
// shows between the two must not be a hole.

#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

// Positions are in the frame.
[[nodiscard]] Mesh make_mesh(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Exposure& exposure,
                             const std::vector<Color>& radiosity);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/make_mesh.cpp>
#endif
