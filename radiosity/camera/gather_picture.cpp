// SPDX-License-Identifier: MIT
#include <radiosity/camera/gather_picture.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/inline.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/indirect_points.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/smooth_shadows.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {
namespace detail {

class GatherPainter {
 public:
  GatherPainter(const FinalGather& light, const View& view, unsigned threads, const Control& control)
      : light_{light},
        view_{view},
        blocks_{view.size, threads, control},
        seen_{light, view, blocks_},
        points_{view.size.width, view.size.height},
        indirect_(blocks_.count()),
        irradiance_(blocks_.count()) {}

  // Finds what all pixels show. False when cancelled.
  [[nodiscard]] bool look() { return seen_.look(); }
  [[nodiscard]] bool gather();
  [[nodiscard]] bool light_up(const Tone& tone, Picture& picture) {
    SmoothShadows shadows{light_, view_, blocks_, seen_, indirect_, irradiance_};
    return blocks_.each_block(0.7, 0.9, [&](std::size_t b) { light_block(b); }) && shadows.smooth(0.9, 0.99) &&
           blocks_.each_block(0.99, 1.0, [&](std::size_t b) { show(b, tone, picture); });
  }

 private:
  [[nodiscard]] Color indirect_at(const Fragment& f) const;
  void light_block(std::size_t block);
  void show(std::size_t block, const Tone& tone, Picture& picture) const;
  [[nodiscard]] FinalGather::Indirect indirect(const Fragment& fragment, const GatherRays& rays) const;
  [[nodiscard]] IndirectPoint gather_at(const Fragment& fragment, const GatherRays& rays) const;

  const FinalGather& light_;
  const View& view_;
  PictureBlocks blocks_;
  SeenSurfaces seen_;
  IndirectPoints points_;
  SmoothShadows::Lights indirect_, irradiance_;  // of which the first is a part
};

HALFLIGHT_INLINE FinalGather::Indirect GatherPainter::indirect(const Fragment& fragment, const GatherRays& rays) const {
  const std::uint64_t pixel = blocks_.pixel(fragment.x, fragment.y);
  const std::uint64_t key = scramble(pixel ^ std::uint64_t{rays.least - gather_rays.least} << 32) ^ fragment.place.surface;
  return light_.indirect(fragment.place, rays, key);
}

HALFLIGHT_INLINE IndirectPoint GatherPainter::gather_at(const Fragment& fragment, const GatherRays& rays) const {
  const auto found = indirect(fragment, rays);
  return indirect_point(found, {fragment.x, fragment.y}, fragment.place, seen_.eye().position,
                        seen_.pixel_size()(fragment.place.point.position));
}

HALFLIGHT_INLINE bool GatherPainter::gather() {
  if (light_.direct_alone()) { return true; }
  std::vector<std::vector<std::uint32_t>> wanted(blocks_.count());  // fragments that need a point, by block
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  std::vector<IndirectPoint> found;
  std::vector<Fragment> fragments;  // in which these points lie
  double done = 0.3;
  // Every 16th pixel, every 8th and so on. The last pass gives all that is still uncovered a point of its own.
  struct Pass {
    std::uint32_t stride;
    bool last;
  };
  for (const Pass pass : {Pass{16, false}, {8, false}, {4, false}, {2, false}, {1, false}, {1, true}}) {
    const auto ask = [&](std::size_t b) {
      wanted[b].clear();
      for (std::uint32_t i = 0; i < seen_.of(b).size(); ++i) {
        const Fragment& f = seen_.of(b)[i];
        if (f.x % pass.stride != 0 || f.y % pass.stride != 0) { continue; }
        const auto& p = f.place.point;
        if (is_black(light_.material(f.place.surface).reflectance)) { continue; }
        if (points_.covered(f.x, f.y, p.position, p.normal, f.place.object)) { continue; }
        // Neighbouring pixels do not get two points in one pass: most spheres will cover that distance.
        const double apart = 2.0 * seen_.pixel_size()(p.position);
        const bool near = !pass.last && std::any_of(wanted[b].begin(), wanted[b].end(), [&](std::uint32_t k) {
          const auto& other = seen_.of(b)[k].place;
          return other.object == f.place.object && glm::dot(other.point.normal, p.normal) > 0.95 &&
                 glm::length(other.point.position - p.position) < apart;
        });
        if (!near) { wanted[b].push_back(i); }
      }
    };
    if (!blocks_.each_block(done, done + 0.01, ask)) { return false; }
    all.clear();
    for (std::uint32_t b = 0; b < wanted.size(); ++b) {
      for (const std::uint32_t i : wanted[b]) { all.emplace_back(b, i); }
    }
    found.resize(all.size());
    const GatherRays& rays = pass.stride > 1 ? gather_rays : gather_rays_between;
    const auto gather_one = [&](std::size_t k) { found[k] = gather_at(seen_.of(all[k].first)[all[k].second], rays); };
    const auto report = [&](std::size_t count) {
      blocks_.control().report("picture", done + 0.05 * static_cast<double>(count) / static_cast<double>(all.size()));
    };
    if (!parallel_in_batches(blocks_.control(), blocks_.threads(), all.size(), {1024, 8}, gather_one, report)) { return false; }
    for (const IndirectPoint& point : found) { points_.add(point); }
    for (const auto& [block, i] : all) { fragments.push_back(seen_.of(block)[i]); }
    done += 0.06;
  }
  const auto again = [&](std::size_t i) { return indirect(fragments[i], gather_rays_again); };
  if (!points_.gather_again(blocks_.threads(), blocks_.control(), again)) { return false; }
  const auto fit = [&](std::size_t i) { points_.fit(i); };
  return parallel_in_batches(blocks_.control(), blocks_.threads(), points_.size(), {points_.size(), 64}, fit);
}

// Indirect irradiance, interpolated between the points.
HALFLIGHT_INLINE Color GatherPainter::indirect_at(const Fragment& f) const {
  return points_.at(f.x, f.y, f.place.point.position, f.place.point.normal, f.place.object).value_or(Color{0.0});
}

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
    for (const std::uint32_t i : own) { indirect[i] = irradiance[i] = indirect_at(fragments[i]); }
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
                                             const Control& control) {
  Picture picture{view.size.width, view.size.height};
  detail::GatherPainter painter{light, view, threads, control};
  if (!painter.look() || !painter.gather() || !painter.light_up(tone, picture)) { return std::nullopt; }
  return picture;
}

}  // namespace radiosity
