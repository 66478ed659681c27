// SPDX-License-Identifier: MIT
#include "apps/raycast_picture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>

namespace apps {
namespace {

constexpr std::uint32_t nothing = 0x7fffffff, several = 0x7ffffffe;  // in place of the number of a surface

// What is known of a pixel from some of its samples.
struct Glance {
  radiosity::Color shown{0.0};      // mean
  radiosity::Color radiosity{0.0};  // mean
  std::uint32_t surface = several;  // that all samples have met
  bool even = true;                 // their colours differ by at most four of 255 levels
};

class Sampler {
 public:
  Sampler(const radiosity::Lookup& lookup, const View& view, const Tone& tone, unsigned samples) : lookup_{lookup}, view_{view}, tone_{tone} {
    for (unsigned s = 0; s < samples * samples; ++s) {
      const unsigned x = s % samples, y = s / samples;
      const glm::dvec2 at{(x + 0.5) / samples, (y + 0.5) / samples};
      all_.push_back(at);
      if (samples % 2 != 0 || x == (2 * y + 1) % (samples + 1)) { few_.push_back(at); }
    }
  }

  // A glance takes one sample in every row and every column of a pixel; of an odd number of rows all.
  [[nodiscard]] bool glance_is_all() const { return few_.size() == all_.size(); }

  // Pixels `first` to `first + count` in the order of rows.
  void look(std::size_t first, std::size_t count, bool closer, Glance* out) const {
    const std::vector<glm::dvec2>& at = closer ? all_ : few_;
    std::array<glm::dvec3, 16> directions{};
    radiosity::Color sum(0.0), radiosity(0.0);
    Rgb8 least{}, most{};
    const std::size_t rays = count * at.size();
    for (std::size_t done = 0; done < rays; done += 16) {
      const std::size_t together = std::min<std::size_t>(16, rays - done);
      for (std::size_t k = 0; k < together; ++k) {
        const std::size_t pixel = first + (done + k) / at.size();
        const glm::dvec2& in_pixel = at[(done + k) % at.size()];
        directions[k] = view_.direction(static_cast<double>(pixel % view_.size.width) + in_pixel.x,
                                        static_cast<double>(pixel / view_.size.width) + in_pixel.y);
      }
      const auto seen = lookup_.seen16(view_.eye, std::span(directions.data(), together));
      for (std::size_t k = 0; k < together; ++k) {
        Glance& glance = out[(done + k) / at.size()];
        const std::size_t sample = (done + k) % at.size();
        const radiosity::Color light = seen[k] ? seen[k]->radiosity : radiosity::Color(0.0);
        const radiosity::Color color = tone_(light);
        const std::uint32_t surface = seen[k] ? seen[k]->surface : nothing;
        const Rgb8 rgb = closer ? Rgb8{} : to_rgb8(color);
        if (sample == 0) { glance.surface = surface, sum = radiosity = radiosity::Color(0.0), least = most = rgb; }
        sum += color;
        radiosity += light;
        for (std::size_t c = 0; c < 3; ++c) {
          least[c] = std::min(least[c], rgb[c]);
          most[c] = std::max(most[c], rgb[c]);
          glance.even = glance.even && most[c] - least[c] <= 4;
        }
        if (surface != glance.surface) { glance.surface = several; }
        if (sample + 1 == at.size()) {
          glance.shown = sum / static_cast<double>(at.size());
          glance.radiosity = radiosity / static_cast<double>(at.size());
        }
      }
    }
  }

 private:
  const radiosity::Lookup& lookup_;
  const View& view_;
  Tone tone_;
  std::vector<glm::dvec2> few_, all_;
};

}  // namespace

std::optional<Picture> draw(const radiosity::Lookup& lookup, const View& view, const Tone& tone, unsigned threads, unsigned samples,
                            const radiosity::Control& control) {
  Picture picture{view.size.width, view.size.height};
  const std::size_t width = view.size.width, height = view.size.height, count = width * height;
  const Sampler sampler(lookup, view, tone, samples);
  std::vector<std::uint32_t> surfaces(count);  // of which the first bit: a close look is needed anyway
  const auto paint = [&](std::size_t pixel, const Glance& glance) { picture.set(pixel, glance.shown, glance.radiosity); };
  constexpr std::size_t group = 4;  // pixels
  const auto glance_at = [&](std::size_t first) {
    std::array<Glance, group> glances;
    const std::size_t pixels = std::min(group, count - first);
    sampler.look(first, pixels, false, glances.data());
    for (std::size_t i = 0; i < pixels; ++i) {
      paint(first + i, glances[i]);
      surfaces[first + i] = glances[i].surface | (glances[i].even ? 0u : 0x80000000u);
    }
  };
  const auto needs_more = [&](std::size_t pixel) {
    const std::size_t x = pixel % width, y = pixel / width;
    const std::uint32_t surface = surfaces[pixel];
    if (surface >= several && surface != nothing) { return true; }
    for (std::size_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, height); ++v) {
      for (std::size_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, width); ++u) {
        if ((surfaces[v * width + u] & nothing) != surface) { return true; }
      }
    }
    return false;
  };
  const auto look_at = [&](std::size_t pixel) {
    if (sampler.glance_is_all() || !needs_more(pixel)) { return; }
    Glance glance;
    sampler.look(pixel, 1, true, &glance);
    paint(pixel, glance);
  };
  // About a quarter of a million rays between two looks at the cancel flag.
  const std::size_t batch = std::max<std::size_t>((std::size_t{1} << 18) / (std::size_t{samples} * samples), 64) / group * group;
  for (const bool closer : {false, true}) {
    for (std::size_t first = 0; first < count; first += batch) {
      if (control.cancelled()) { return std::nullopt; }
      const std::size_t pixels = std::min(batch, count - first), step = closer ? 1 : group;
      radiosity::parallel_for((pixels + step - 1) / step, radiosity::thread_count(threads),
                              [&](std::size_t i) { closer ? look_at(first + step * i) : glance_at(first + step * i); });
      control.report("picture", ((closer ? 0.5 : 0.0) + 0.5 * static_cast<double>(first + pixels) / static_cast<double>(count)));
    }
  }
  return picture;
}

}  // namespace apps
