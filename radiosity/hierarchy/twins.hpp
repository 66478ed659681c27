// SPDX-License-Identifier: MIT
#pragma once

// Objects of which a scene holds copies at one place, as a list of files or a line that was pasted twice makes them. The last is seen, and
// rays need not meet the others (raycast::Scene::leave_out).

#include <array>
#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Pairs (earlier, later) of objects whose surfaces are the same: each corner of one is a corner of the other, or lies on it when it is
// curved, and the other way round, to 1e-9 of the size, and both face the same way. Compared are objects whose bounds agree to a millionth
// of the scene. Each object is the earlier one of one pair at most, and then the later one of none; the pairs are sorted by the earlier.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> twins(const std::vector<Surface>& surfaces);

// The earlier object of each pair, for raycast::Scene::leave_out.
[[nodiscard]] std::vector<std::uint32_t> copies(const std::vector<Surface>& surfaces);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/twins.cpp>
#endif
