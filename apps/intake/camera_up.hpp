// SPDX-License-Identifier: MIT
#pragma once

// Finds the vertical axis of a file whose cameras contradict that of its format, as those of exporters do that write z up into a format
// with y up.

#include <optional>
#include <span>

#include <radiosity/camera/view.hpp>

#include "apps/intake/model.hpp"

namespace apps {

// The axis that all cameras take as up, if that is y or z and not `up`; in the file's coordinates. Nothing in doubt.
//
// A camera that is not rolled about its direction has its right hand in the horizontal plane, wherever it looks: also straight down,
// where its up vector says nothing. All cameras must be so about the other axis, to within 3 degrees. One at least must contradict `up`:
// were that vertical, it would be rolled by 6 degrees or more. It must be turned and pitched, too, by as much, because a camera that lies
// on its side and looks horizontally or along an axis is level about two axes. If all that contradict `up` look in one direction, chance
// could make a rolled camera level: 0.7 degrees then.
[[nodiscard]] std::optional<UpAxis> up_of_cameras(std::span<const radiosity::Camera> cameras, UpAxis up);

}  // namespace apps
