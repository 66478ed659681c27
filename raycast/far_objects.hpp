// SPDX-License-Identifier: MIT
#pragma once

// Objects far away from all others, such as suns. If they were compiled with the others (compiled.hpp), the error bound of single
// precision, which is relative to the extent of all that is compiled, would be as large as many of the others' faces.

#include <cstdint>
#include <span>
#include <vector>

#include <raycast/transform.hpp>

namespace raycast {

// The far objects, in ascending order: at most 16, with at most a tenth of all sheets. From the middle of the others, each is more than
// eight times as far away, along some axis, as any of these reaches. Empty if there are none. Time: n log n.
[[nodiscard]] std::vector<std::uint32_t> far_objects(std::span<const PlacedObject> objects);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/far_objects.cpp>
#endif
