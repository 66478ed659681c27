// SPDX-License-Identifier: MIT
#pragma once

// The rays, radiosities and grey levels of a drawn picture, in the form that the picture's audit reads (radiosity/audit/picture_error.hpp).

#include <radiosity/audit/picture_error.hpp>

#include "apps/color.hpp"
#include "apps/picture.hpp"
#include "apps/view.hpp"

namespace apps {

// `picture` must outlive the result.
[[nodiscard]] inline radiosity::ShownPicture audited(const Picture& picture, const View& view, const Tone& tone) {
  return {picture.width, picture.height,
          [view](double x, double y) {
            return raycast::Segment{view.eye, view.direction(x, y)};
          },
          [&picture](std::uint32_t x, std::uint32_t y) { return picture.radiosity[std::size_t{y} * picture.width + x]; },
          [tone](double radiosity) { return 255.0 * srgb_encode(tone(radiosity)); }};
}

}  // namespace apps
