// SPDX-License-Identifier: MIT
#include "apps/raycast_picture.hpp"

#include <algorithm>
#include <cstddef>

#include <radiosity/parallel.hpp>

namespace apps {

std::optional<Picture> draw(const radiosity::Lookup& lookup, const View& view, double exposure, unsigned threads, unsigned samples,
                            const radiosity::Control& control) {
  Picture picture{view.size.width, view.size.height, {}};
  const std::size_t width = view.size.width;
  const std::size_t count = width * view.size.height;
  picture.rgb.resize(3 * count);
  const auto draw_pixel = [&](std::size_t i) {
    radiosity::Color sum(0.0);
    for (unsigned s = 0; s < samples * samples; ++s) {
      const double x = static_cast<double>(i % width) + (s % samples + 0.5) / samples;
      const double y = static_cast<double>(i / width) + (s / samples + 0.5) / samples;
      if (const auto radiosity = lookup.seen(view.eye, view.direction(x, y))) { sum += shown(*radiosity, exposure); }
    }
    const Rgb8 rgb = to_rgb8(sum / static_cast<double>(samples * samples));
    std::copy(rgb.begin(), rgb.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  };
  // About a quarter of a million rays between two looks at the cancel flag.
  const std::size_t batch = std::max<std::size_t>((std::size_t{1} << 18) / (std::size_t{samples} * samples), 64);
  for (std::size_t first = 0; first < count; first += batch) {
    if (control.cancelled()) { return std::nullopt; }
    const std::size_t pixels = std::min(batch, count - first);
    radiosity::parallel_for(pixels, radiosity::thread_count(threads), [&](std::size_t offset) { draw_pixel(first + offset); });
    control.report("picture", static_cast<double>(first + pixels) / static_cast<double>(count));
  }
  return picture;
}

}  // namespace apps
