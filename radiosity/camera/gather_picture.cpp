// SPDX-License-Identifier: MIT
#include <radiosity/camera/gather_picture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <raycast/inline.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/indirect_points.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/shadow_edges.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/support/parallel.hpp>
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
        irradiance_(blocks_.count()),
        lit_(std::size_t{view.size.width} * view.size.height, 0.0f) {}

  // Finds what all pixels show. False when cancelled.
  [[nodiscard]] bool look() { return seen_.look(); }
  [[nodiscard]] bool gather();
  [[nodiscard]] bool light_up(const Tone& tone, Picture& picture) {
    return blocks_.each_block(0.7, 0.9, [&](std::size_t b) { light_block(b); }) && blocks_.each_block(0.9, 1.0, [&](std::size_t b) {
      smooth_shadows(b);
      show(b, tone, picture);
    });
  }

 private:
  [[nodiscard]] Color indirect_at(const Fragment& f) const;
  void light_block(std::size_t block);
  [[nodiscard]] bool on_edge(std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] std::vector<FinalGather::Place> places_of(const Fragment& fragment, std::span<const glm::dvec2> at) const;
  void smooth_shadows(std::size_t block);
  void show(std::size_t block, const Tone& tone, Picture& picture) const;
  [[nodiscard]] FinalGather::Indirect indirect(const Fragment& fragment, const GatherRays& rays) const;
  [[nodiscard]] IndirectPoint gather_at(const Fragment& fragment, const GatherRays& rays) const;

  const FinalGather& light_;
  const View& view_;
  PictureBlocks blocks_;
  SeenSurfaces seen_;
  IndirectPoints points_;
  std::vector<std::vector<Color>> irradiance_;  // of the fragments, by block
  std::vector<float> lit_;                      // by pixel: its irradiance, summed over the channels, if it shows one surface
  std::array<glm::dvec2, 16> sixteen_ = SeenSurfaces::points<4>();
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
  parallel_for(points_.size(), blocks_.threads(), [&](std::size_t i) { points_.fit(i); });
  return true;
}

// Indirect irradiance, interpolated between the points.
HALFLIGHT_INLINE Color GatherPainter::indirect_at(const Fragment& f) const {
  return points_.at(f.x, f.y, f.place.point.position, f.place.point.normal, f.place.object).value_or(Color{0.0});
}

HALFLIGHT_INLINE void GatherPainter::light_block(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  std::vector<Color>& irradiance = irradiance_[block];
  irradiance.assign(fragments.size(), Color{0.0});
  std::vector<std::uint32_t> order(fragments.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) { order[i] = i; }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return fragments[a].place.surface < fragments[b].place.surface; });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const std::uint32_t surface = fragments[order[begin]].place.surface;
    while (end < order.size() && fragments[order[end]].place.surface == surface) { ++end; }
    if (is_black(light_.material(surface).reflectance)) { continue; }
    const auto own = std::span(order).subspan(begin, end - begin);
    for (const std::uint32_t i : own) { irradiance[i] = indirect_at(fragments[i]); }
    add_direct_light(light_, own, fragments, irradiance);
    for (const std::uint32_t i : own) {
      const Fragment& f = fragments[i];
      if (seen_.surface(blocks_.pixel(f.x, f.y)) == surface) {
        lit_[blocks_.pixel(f.x, f.y)] = static_cast<float>(irradiance[i].x + irradiance[i].y + irradiance[i].z);
      }
    }
  }
}

// Does the light change much from this pixel to a neighbour on the same surface?
HALFLIGHT_INLINE bool GatherPainter::on_edge(std::uint32_t x, std::uint32_t y) const {
  const auto at = [&](std::uint32_t u, std::uint32_t v) { return std::size_t{v} * view_.size.width + u; };
  const auto differs = [&](std::size_t a, std::size_t b) {
    return seen_.surface(a) == seen_.surface(b) &&
           std::abs(lit_[a] - lit_[b]) > static_cast<float>(change_at_edge) * std::max(lit_[a], lit_[b]);
  };
  const std::size_t own = at(x, y);
  return (x > 0 && differs(own, at(x - 1, y))) || (x + 1 < view_.size.width && differs(own, at(x + 1, y))) ||
         (y > 0 && differs(own, at(x, y - 1))) || (y + 1 < view_.size.height && differs(own, at(x, y + 1)));
}

// The places where rays through these points of the fragment's pixel meet its surface.
HALFLIGHT_INLINE std::vector<FinalGather::Place> GatherPainter::places_of(const Fragment& fragment, std::span<const glm::dvec2> at) const {
  std::vector<FinalGather::Place> places;
  for (const glm::dvec2& p : at) {
    const auto place = light_.beside(fragment.place, seen_.eye().position, view_.direction(fragment.x + p.x, fragment.y + p.y));
    if (place) { places.push_back(*place); }
  }
  return places;
}

// Where the edge of a shadow runs through a pixel, replaces its direct light by the mean over the pixel. Pixels of a block
// share the list of possible blockers.
HALFLIGHT_INLINE void GatherPainter::smooth_shadows(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < fragments.size(); ++i) {
    const Fragment& f = fragments[i];
    if (f.share != 1.0f || f.place.surface != seen_.surface(blocks_.pixel(f.x, f.y)) || !on_edge(f.x, f.y)) { continue; }
    if (!is_black(light_.material(f.place.surface).reflectance)) { order.push_back(i); }
  }
  const auto surface = [&](std::uint32_t i) { return fragments[i].place.surface; };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return surface(a) < surface(b); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    std::vector<FinalGather::Place> all;
    std::vector<std::vector<FinalGather::Place>> many;  // places, by pixel
    for (; end < order.size() && surface(order[end]) == surface(order[begin]); ++end) {
      all.push_back(fragments[order[end]].place);
      many.push_back(places_of(fragments[order[end]], sixteen_));
      all.insert(all.end(), many.back().begin(), many.back().end());
    }
    LitRegion region = light_.lit_region(all);
    for (std::size_t k = begin; k < end; ++k) {
      const Fragment& f = fragments[order[k]];
      const auto direct = over_pixel(region, f.place, places_of(f, SeenSurfaces::four), many[k - begin]);
      if (direct) { irradiance_[block][order[k]] = *direct + indirect_at(f); }
    }
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
