// SPDX-License-Identifier: MIT
#include <radiosity/camera/gather_picture.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/indirect_light.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/smooth_shadows.hpp>

namespace radiosity {
namespace detail {

class GatherPainter {
 public:
  GatherPainter(const FinalGather& light, const View& view, unsigned threads, const Control& control, std::uint64_t memory)
      : light_{light},
        view_{view},
        blocks_{view.size, threads, control, memory},
        seen_{light, view, blocks_},
        light_between_{light, view.size, blocks_, seen_},
        indirect_(blocks_.count()),
        irradiance_(blocks_.count()) {
    // What every pixel takes: 37 bytes of the picture, 8 of numbers and 16 while more rays are chosen; and every block: its lists.
    constexpr std::uint64_t a_pixel = 64, a_block = 512;
    blocks_.take(a_pixel * view.size.width * view.size.height + a_block * blocks_.count());
  }

  // Finds what all pixels show. False when cancelled or if it takes too much memory, as are the stages that follow.
  [[nodiscard]] bool look() { return seen_.look(); }
  [[nodiscard]] bool gather() { return light_.direct_alone() || light_between_.gather(0.3, 0.66); }
  [[nodiscard]] bool light_up(const Tone& tone, Picture& picture) {
    SmoothShadows shadows{light_, view_, blocks_, seen_, indirect_, irradiance_};
    return blocks_.each_block(0.7, 0.9, [&](std::size_t b) { light_block(b); }) && shadows.smooth(0.9, 0.99) &&
           blocks_.each_block(0.99, 1.0, [&](std::size_t b) { show(b, tone, picture); });
  }

 private:
  void light_block(std::size_t block);
  void show(std::size_t block, const Tone& tone, Picture& picture) const;

  const FinalGather& light_;
  const View& view_;
  PictureBlocks blocks_;
  SeenSurfaces seen_;
  IndirectLight light_between_;
  SmoothShadows::Lights indirect_, irradiance_;  // of which the first is a part
};

HALFLIGHT_INLINE void GatherPainter::light_block(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  std::vector<Color>& irradiance = irradiance_[block];
  std::vector<Color>& indirect = indirect_[block];
  irradiance.assign(fragments.size(), Color{0.0});
  indirect = irradiance;
  std::vector<std::uint32_t> order(fragments.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) { order[i] = i; }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return fragments[a].place.surface < fragments[b].place.surface; });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const std::uint32_t surface = fragments[order[begin]].place.surface;
    while (end < order.size() && fragments[order[end]].place.surface == surface) { ++end; }
    if (is_black(light_.material(surface).reflectance)) { continue; }
    if (blocks_.control().cancelled()) { return; }
    const auto own = std::span(order).subspan(begin, end - begin);
    for (const std::uint32_t i : own) { indirect[i] = irradiance[i] = light_between_.at(fragments[i]); }
    add_direct_light(light_, own, fragments, irradiance);
  }
}

HALFLIGHT_INLINE void GatherPainter::show(std::size_t block, const Tone& tone, Picture& picture) const {
  const std::vector<Fragment>& fragments = seen_.of(block);
  auto next = fragments.begin();
  blocks_.each_pixel(block, [&](std::uint32_t x, std::uint32_t y) {
    const std::size_t pixel = blocks_.pixel(x, y);
    Color sum{0.0}, all{0.0};
    float share = 0.0f;
    std::optional<Color> emission;  // emission of the first fragment
    for (; next != fragments.end() && next->x == x && next->y == y; ++next) {
      const Material& material = light_.material(next->place.surface);
      if (emission.value_or(material.emission) != material.emission) { picture.partly_lamp[pixel] = 1; }
      emission = material.emission;
      share += next->share;
      const Color b = material.emission + material.reflectance * irradiance_[block][static_cast<std::size_t>(next - fragments.begin())];
      sum += static_cast<double>(next->share) * tone(b);
      all += static_cast<double>(next->share) * b;
    }
    const bool beyond = share < 1.0f - 1e-4f;  // a part of the pixel shows the background, which emits nothing
    if (beyond && !radiosity::is_black(emission.value_or(Color{0.0}))) { picture.partly_lamp[pixel] = 1; }
    picture.set(pixel, sum, all);
  });
}

}  // namespace detail

HALFLIGHT_INLINE std::optional<Picture> draw(const FinalGather& light, const View& view, const Tone& tone, unsigned threads,
                                             const Control& control, std::uint64_t memory) {
  detail::GatherPainter painter{light, view, threads, control, memory};
  Picture picture{view.size.width, view.size.height};
  if (!painter.look() || !painter.gather() || !painter.light_up(tone, picture)) { return std::nullopt; }
  return picture;
}

}  // namespace radiosity
