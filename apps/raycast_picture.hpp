// SPDX-License-Identifier: MIT
#pragma once

// The picture of the true objects: rays through the same sample points as those of the mesh picture (picture.hpp), each shaded with the
// solved radiosity at the point that it meets (radiosity/picture/lookup.hpp). Silhouettes are those of the objects at any zoom; on plane
// surfaces it is the mesh picture. Exposure, clamping and averaging are the same, too.
//
// A pixel begins with one sample in each row and each column of its grid, of which the mean is exact where the colour changes evenly.
// Where these meet several surfaces, a neighbour's meet another one, or their colours differ by more than 4 of 255 levels, the
// pixel is sampled in full. Nothing of this depends on the number of threads.

#include <optional>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/picture.hpp"
#include "apps/view.hpp"

namespace apps {

// Where there is no object the picture is black. Reports the stage "picture". Nothing when control.cancel became true.
[[nodiscard]] std::optional<Picture> draw(const radiosity::Lookup& lookup, const View& view, const Tone& tone, unsigned threads = 0,
                                          unsigned samples = 4, const radiosity::Control& control = {});

}  // namespace apps
