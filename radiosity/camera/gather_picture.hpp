// SPDX-License-Identifier: MIT
#pragma once

// Renders the true objects (not the mesh) in gathered light (radiosity/picture/final_gather.hpp): direct light at every pixel, indirect
// light at sparse points between which it is interpolated (indirect_points.hpp).
//
// What the rays of a pixel meet of one surface is one fragment (seen_surfaces.hpp). It is lit at one place, at several where the edge of a
// shadow crosses it (smooth_shadows.hpp). Exposure and clamping are those of the mesh picture (mesh_picture.hpp). The result does not
// depend on the number of threads.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <radiosity/audit/picture_error.hpp>
#include <radiosity/camera/picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// The background is black. Reports the stage "picture". `memory`: bytes that it may take. Nothing when control.cancel became true, or, with
// any number of threads, if it would take more memory.
[[nodiscard]] std::optional<Picture> draw(const FinalGather& light, const View& view, const Tone& tone, unsigned threads = 0,
                                          const Control& control = {}, std::uint64_t memory = std::numeric_limits<std::uint64_t>::max());

// The picture as the audit needs it. `picture` must outlive the result.
[[nodiscard]] inline ShownPicture audited(const Picture& picture, const View& view, const Tone& tone) {
  return {picture.width,
          picture.height,
          [view](double x, double y) {
            return raycast::Segment{view.eye, view.direction(x, y)};
          },
          [&picture](std::uint32_t x, std::uint32_t y) { return picture.radiosity[std::size_t{y} * picture.width + x]; },
          [tone](double radiosity) { return 255.0 * srgb_encode(tone(radiosity)); },
          [&picture](std::uint32_t x, std::uint32_t y) { return picture.partly_lamp[std::size_t{y} * picture.width + x] != 0; }};
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/gather_picture.cpp>
#endif
