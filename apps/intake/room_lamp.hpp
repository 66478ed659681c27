// SPDX-License-Identifier: MIT
#pragma once

// Places a lamp in a room that has none.

#include <memory>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>

namespace apps {

// A square close below the ceiling (z up) of the room within these bounds, facing down, in the middle of where there is most air around and
// below it, in the upper half of the room if there is a place. Its side is .6 of the distance to what is around it. Null if no place was
// found, or only narrow gaps. The same lamp wherever the room stands, and up to some hundredths however it is turned about the vertical.
[[nodiscard]] std::shared_ptr<const raycast::Object> room_lamp(const raycast::Scene& objects, const raycast::Box& room);

}  // namespace apps
