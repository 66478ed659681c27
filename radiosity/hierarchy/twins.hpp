// SPDX-License-Identifier: MIT
#pragma once

// Duplicate objects at the same place, as they result from a file listed twice or a line pasted twice. The last one is seen, and rays
// need not test the others (raycast::Scene::leave_out).

#include <array>
#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Pairs (earlier, later) of objects with the same surface: each corner of one is a corner of the other (or lies on it, if it is curved),
// and vice versa, to 1e-9 of the size, and both face the same way. Only objects whose bounds agree to a millionth of the scene are
// compared. Each object is the earlier one of at most one pair and then the later one of none. The pairs are sorted by the earlier object.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> twins(const std::vector<Surface>& surfaces);

// The earlier object of each pair, as input of raycast::Scene::leave_out.
[[nodiscard]] std::vector<std::uint32_t> copies(const std::vector<Surface>& surfaces);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/twins.cpp>
#endif
