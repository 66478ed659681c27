// SPDX-License-Identifier: MIT
#include <radiosity/camera/seen_surfaces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE SeenSurfaces::SeenSurfaces(const FinalGather& light, const View& view, const PictureBlocks& blocks)
    : light_{light},
      view_{view},
      blocks_{blocks},
      eye_{light.eye(view.eye)},
      pixel_size_{eye_.position, 2.0 * view.half_width / view.size.width, 1e-12 * light.objects().diameter()},
      fragments_(blocks.count()),
      surfaces_(std::size_t{view.size.width} * view.size.height, no_surface) {}

HALFLIGHT_INLINE void SeenSurfaces::store(std::size_t block, const std::vector<Fragment>& fragments) {
  std::vector<Fragment>& own = fragments_[block];
  if (fragments.size() > own.size()) { blocks_.take((fragments.size() - own.size()) * bytes_of_fragment); }
  own = std::vector<Fragment>(fragments.begin(), fragments.end());  // takes no more than it needs
}

HALFLIGHT_INLINE void SeenSurfaces::glance(std::size_t block) {
  std::vector<Fragment> result;
  std::array<glm::dvec3, 16> directions{};
  std::array<std::pair<std::uint32_t, std::uint32_t>, 4> pixels{};
  unsigned waiting = 0;
  const auto look = [&] {
    const auto seen = light_.seen16(eye_, std::span(directions.data(), 4 * waiting), false);
    for (unsigned k = 0; k < waiting; ++k) {
      const auto [x, y] = pixels[k];
      const auto own = std::span(seen).subspan(4 * k, 4);
      std::uint32_t& surface = surfaces_[blocks_.pixel(x, y)];
      surface = own[0] ? own[0]->surface : no_surface;
      for (const auto& place : own) {
        if (place.has_value() != own[0].has_value() || (place && !one_piece(*own[0], *place, pixel_size_))) { surface = several_surfaces; }
      }
      add_fragments(light_, x, y, own, pixel_size_, result);
    }
    waiting = 0;
  };
  blocks_.each_pixel(block, [&](std::uint32_t x, std::uint32_t y) {
    for (unsigned k = 0; k < 4; ++k) { directions[4 * waiting + k] = view_.direction(x + four[k].x, y + four[k].y); }
    pixels[waiting++] = {x, y};
    if (waiting == 4) { look(); }
  });
  if (waiting > 0) { look(); }
  store(block, result);
}

HALFLIGHT_INLINE std::span<const Fragment> SeenSurfaces::at(std::uint32_t x, std::uint32_t y) const {
  const std::vector<Fragment>& all = fragments_[blocks_.block(x, y)];
  const auto before = [](const Fragment& f, const std::pair<std::uint32_t, std::uint32_t>& pixel) {
    return std::pair{f.y, f.x} < std::pair{pixel.second, pixel.first};
  };
  const auto first = std::lower_bound(all.begin(), all.end(), std::pair{x, y}, before);
  auto last = first;
  while (last != all.end() && last->x == x && last->y == y) { ++last; }
  return {first, last};
}

HALFLIGHT_INLINE bool SeenSurfaces::by_an_edge(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t own = surfaces_[blocks_.pixel(x, y)];
  bool edge = own == several_surfaces;
  blocks_.each_neighbour(x, y, [&](std::uint32_t u, std::uint32_t v) { edge = edge || surfaces_[blocks_.pixel(u, v)] != own; });
  return edge;
}

template <class Wanted>
void SeenSurfaces::look_again(std::size_t block, const Wanted& wanted, std::span<const glm::dvec2> at) {
  std::vector<Fragment> result;
  auto next = fragments_[block].begin();
  bool changed = false;
  blocks_.each_pixel(block, [&](std::uint32_t x, std::uint32_t y) {
    const auto first = next;
    while (next != fragments_[block].end() && next->x == x && next->y == y) { ++next; }
    if (!wanted(x, y) || blocks_.control().cancelled()) {
      result.insert(result.end(), first, next);
      return;
    }
    changed = true;
    std::vector<std::optional<FinalGather::Place>> seen;
    for (std::size_t k = 0; k < at.size(); k += 16) {
      std::array<glm::dvec3, 16> directions{};
      for (unsigned i = 0; i < 16; ++i) { directions[i] = view_.direction(x + at[k + i].x, y + at[k + i].y); }
      const auto some = light_.seen16(eye_, directions, true);
      seen.insert(seen.end(), some.begin(), some.end());
    }
    add_fragments(light_, x, y, seen, pixel_size_, result);
  });
  if (changed) { store(block, result); }
}

namespace detail {

// The RMS error of the share of either side of an edge that runs through a pixel in any direction, and how many rays tell it.
struct ShareByRays {
  std::size_t rays;
  double error;
};
inline constexpr std::array<ShareByRays, 3> share_by_rays{ShareByRays{16, 0.04}, {64, 0.0145}, {256, 0.005}};
// The expected error that edges may leave in the picture, relative to the RMS of what it shows: a third of the 1 % that pictures aim at.
// And the rays spent on it, by pixel: with fewer than the first four, pictures of the examples take at most 8 % longer.
inline constexpr double left_by_edges = 0.003, rays_for_edges = 3.0;
inline constexpr std::uint32_t lattice_step = 4;  // of every block of 4 x 4 pixels one tells how bright the picture is

}  // namespace detail

HALFLIGHT_INLINE void SeenSurfaces::compare_sides(std::size_t block, std::vector<Range>& ranges) const {
  const std::vector<Fragment>& fragments = fragments_[block];
  auto next = fragments.begin();
  blocks_.each_pixel(block, [&](std::uint32_t x, std::uint32_t y) {
    const auto first = next;
    while (next != fragments.end() && next->x == x && next->y == y) { ++next; }
    const bool tells = x % detail::lattice_step == 0 && y % detail::lattice_step == 0;
    if (!tells && !by_an_edge(x, y)) { return; }
    Range& range = ranges[blocks_.pixel(x, y)];
    float share = 0.0f;
    const auto shows = [&](double b) { range.extend({b, b}); };
    for (auto f = first; f != next; ++f) {
      const Color& emission = light_.material(f->place.surface).emission;
      share += f->share;
      shows(brightest(light_.solved(f->place).value_or(emission) - emission));
    }
    if (share < 1.0f - 1e-4f) { shows(0.0); }
  });
}

HALFLIGHT_INLINE std::vector<std::uint8_t> SeenSurfaces::rounds(const std::vector<Range>& ranges) const {
  struct Step {  // of one pixel from `round` to the next one
    std::size_t pixel = 0;
    std::uint8_t round = 0;
    double gain = 0.0, a_ray = 0.0;  // decrease of its squared error; the same by the number of rays
  };
  std::vector<Step> steps;
  double unit = 0.0;  // the brightest, as the unit of light, so that squares are finite and not all 0
  for (const Range& range : ranges) { unit = std::max(unit, range.most); }
  if (!(unit > 0.0)) { return std::vector<std::uint8_t>(ranges.size(), 0); }
  double norm = 0.0, off = 0.0;
  for (std::uint32_t y = 0; y < view_.size.height; ++y) {
    for (std::uint32_t x = 0; x < view_.size.width; ++x) {
      const std::size_t own = blocks_.pixel(x, y);
      if (x % detail::lattice_step == 0 && y % detail::lattice_step == 0) {
        const double mean = 0.5 * (ranges[own].least / unit + ranges[own].most / unit);
        norm += detail::lattice_step * detail::lattice_step * mean * mean;
      }
      if (!by_an_edge(x, y)) { continue; }
      Range all;
      blocks_.each_neighbour(x, y, [&](std::uint32_t u, std::uint32_t v) { all.extend(ranges[blocks_.pixel(u, v)]); });
      const double sides = all.most / unit - all.least / unit;
      const auto square = [&](std::size_t round) { return std::pow(detail::share_by_rays[round].error * sides, 2.0); };
      off += square(0);
      for (std::uint8_t round = 0; round + 1u < detail::share_by_rays.size(); ++round) {
        const double gain = square(round) - square(round + 1u);
        steps.push_back({own, round, gain, gain / static_cast<double>(detail::share_by_rays[round + 1u].rays)});
      }
    }
  }
  // The first step of a pixel gains more by its rays than the second one, so it comes first.
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
    return std::tuple{-a.a_ray, a.pixel, a.round} < std::tuple{-b.a_ray, b.pixel, b.round};
  });
  std::vector<std::uint8_t> result(ranges.size(), 0);
  const double allowed = detail::left_by_edges * detail::left_by_edges * norm;
  double left = detail::rays_for_edges * static_cast<double>(ranges.size());
  for (auto step = steps.begin(); step != steps.end() && off > allowed && left > 0.0; ++step) {
    result[step->pixel] = static_cast<std::uint8_t>(step->round + 1);
    off -= step->gain;
    left -= static_cast<double>(detail::share_by_rays[step->round + 1u].rays);
  }
  return result;
}

HALFLIGHT_INLINE bool SeenSurfaces::look() {
  const auto sixteen = points<4>();
  const auto edge = [&](std::uint32_t x, std::uint32_t y) { return by_an_edge(x, y); };
  if (!blocks_.each_block(0.0, 0.15, [&](std::size_t b) { glance(b); })) { return false; }
  if (!blocks_.each_block(0.15, 0.27, [&](std::size_t b) { look_again(b, edge, sixteen); })) { return false; }
  std::vector<Range> ranges(surfaces_.size());
  if (!blocks_.each_block(0.27, 0.28, [&](std::size_t b) { compare_sides(b, ranges); })) { return false; }
  const auto more = points<6>();
  const auto many = points<8>();
  const std::vector<std::uint8_t> round = rounds(ranges);
  return blocks_.each_block(0.28, 0.3, [&](std::size_t b) {
    look_again(
        b, [&](std::uint32_t x, std::uint32_t y) { return round[blocks_.pixel(x, y)] == 1; }, more);
    look_again(
        b, [&](std::uint32_t x, std::uint32_t y) { return round[blocks_.pixel(x, y)] == 2; }, many);
  });
}

}  // namespace radiosity
