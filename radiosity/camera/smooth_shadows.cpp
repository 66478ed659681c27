// SPDX-License-Identifier: MIT
#include <radiosity/camera/smooth_shadows.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/camera/shadow_edges.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/batches.hpp>

namespace radiosity {

HALFLIGHT_INLINE SmoothShadows::SmoothShadows(const FinalGather& light, const View& view, const PictureBlocks& blocks,
                                              const SeenSurfaces& seen, const Lights& indirect, Lights& irradiance)
    : light_{light},
      view_{view},
      blocks_{blocks},
      seen_{seen},
      indirect_{indirect},
      irradiance_{irradiance},
      first_(std::size_t{view.size.width} * view.size.height),
      of_(blocks.count()) {}

HALFLIGHT_INLINE void SmoothShadows::begin(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  OfBlock& of = of_[block];
  of.tested.assign(fragments.size(), Tested::no);
  of.direct.resize(fragments.size());
  for (std::size_t i = 0; i < fragments.size(); ++i) { of.direct[i] = sum_of_channels(irradiance_[block][i] - indirect_[block][i]); }
  std::uint32_t next = 0;
  blocks_.each_pixel(block, [&](std::uint32_t x, std::uint32_t y) {
    first_[blocks_.pixel(x, y)] = next;
    while (next < fragments.size() && fragments[next].x == x && fragments[next].y == y) { ++next; }
  });
}

template <class Visit>
void SmoothShadows::each_beside(const Fragment& own, const Visit& visit) const {
  blocks_.each_neighbour(own.x, own.y, [&](std::uint32_t x, std::uint32_t y) {
    if (x == own.x && y == own.y) { return; }
    const std::size_t b = blocks_.block(x, y);
    const std::vector<Fragment>& fragments = seen_.of(b);
    for (std::uint32_t i = first_[blocks_.pixel(x, y)]; i < fragments.size() && fragments[i].x == x && fragments[i].y == y; ++i) {
      if (one_piece(own.place, fragments[i].place, seen_.pixel_size())) { visit(b, i); }
    }
  });
}

// Does the light change along a row, a column or a diagonal as at an edge? A constant slope does not bend.
HALFLIGHT_INLINE bool SmoothShadows::bends(std::size_t block, std::uint32_t fragment) const {
  const Fragment& own = seen_.of(block)[fragment];
  std::array<double, 9> direct{};  // by pixel, in rows of three
  std::array<bool, 9> known{};
  double most = 0.0;
  const auto add = [&](std::size_t b, std::uint32_t i) {
    const Fragment& f = seen_.of(b)[i];
    const std::size_t at = 3 * (f.y + 1 - own.y) + (f.x + 1 - own.x);
    direct[at] = of_[b].direct[i];
    known[at] = true;
    most = std::max(most, direct[at] + sum_of_channels(indirect_[b][i]));
  };
  add(block, fragment);
  each_beside(own, add);
  constexpr std::size_t here = 4;
  for (std::size_t a = 0; a < here; ++a) {
    const std::size_t b = 2 * here - a;
    if (!known[a] && !known[b]) { continue; }
    const double before = known[a] ? direct[here] - direct[a] : 0.0, after = known[b] ? direct[b] - direct[here] : 0.0;
    if (std::abs(after - before) > change_at_edge * most) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE void SmoothShadows::seek(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  for (std::uint32_t i = 0; i < fragments.size(); ++i) {
    if (is_black(light_.material(fragments[i].place.surface).reflectance) || !bends(block, i)) { continue; }
    of_[block].tested[i] = fragments[i].share == 1.0f ? Tested::few : Tested::many;
    of_[block].wanted.push_back(i);
  }
}

HALFLIGHT_INLINE bool SmoothShadows::follow() {
  for (OfBlock& of : of_) { of.wanted.clear(); }
  bool any = false;
  for (OfBlock& of : of_) {
    for (const auto& [block, fragment] : of.next) {
      if (of_[block].tested[fragment] == Tested::many) { continue; }
      of_[block].tested[fragment] = Tested::many;
      of_[block].wanted.push_back(fragment);
      any = true;
    }
    of.next.clear();
  }
  for (OfBlock& of : of_) { std::sort(of.wanted.begin(), of.wanted.end()); }
  return any;
}

HALFLIGHT_INLINE std::optional<FinalGather::Place> SmoothShadows::within(const Fragment& fragment, const glm::dvec2& at) const {
  return light_.beside(fragment.place, seen_.eye().position, view_.direction(fragment.x + at.x, fragment.y + at.y));
}

HALFLIGHT_INLINE std::array<std::optional<FinalGather::Place>, 16> SmoothShadows::seen16(const Fragment& fragment) const {
  std::array<glm::dvec3, 16> directions{};
  for (unsigned k = 0; k < 16; ++k) { directions[k] = view_.direction(fragment.x + sixteen_[k].x, fragment.y + sixteen_[k].y); }
  return light_.seen16(seen_.eye(), directions, true);
}

HALFLIGHT_INLINE std::vector<SmoothShadows::Asked> SmoothShadows::asked(std::size_t block) const {
  std::vector<Asked> result;
  std::array<std::optional<FinalGather::Place>, 16> seen;
  const Fragment* last = nullptr;  // a fragment of the pixel to which these belong
  for (const std::uint32_t i : of_[block].wanted) {
    const Fragment& f = seen_.of(block)[i];
    const bool whole = f.share == 1.0f;
    if (!whole && (last == nullptr || last->x != f.x || last->y != f.y)) {
      seen = seen16(f);
      last = &f;
    }
    Asked one{i, {}, {}};
    for (std::size_t k = 0; k < sixteen_.size(); ++k) {
      const auto place = whole ? within(f, sixteen_[k]) : seen[k];
      if (!place || !(whole || one_piece(f.place, *place, seen_.pixel_size()))) { continue; }
      one.many.push_back({*place, sixteen_[k]});
    }
    if (one.many.empty()) { continue; }
    if (of_[block].tested[i] == Tested::few) {
      one.few.push_back({f.place, {0.5, 0.5}});
      for (const glm::dvec2& p : SeenSurfaces::four) {
        if (const auto place = within(f, p)) { one.few.push_back({*place, p}); }
      }
    }
    result.push_back(std::move(one));
  }
  return result;
}

// A place of the pixel is near a neighbour if it lies in the half of the pixel beside it, or in the quarter if that is at a corner.
HALFLIGHT_INLINE void SmoothShadows::look_beside(std::size_t block, const Asked& own, const MeanLight& mean) {
  const Fragment& f = seen_.of(block)[own.fragment];
  const auto near = [](double at, std::uint32_t here, std::uint32_t there) { return here == there || (at > 0.5) == (there > here); };
  each_beside(f, [&](std::size_t b, std::uint32_t i) {
    const Fragment& other = seen_.of(b)[i];
    double least = of_[b].direct[i], most = least;
    for (std::size_t k = 0; k < own.many.size(); ++k) {
      if (!near(own.many[k].at.x, f.x, other.x) || !near(own.many[k].at.y, f.y, other.y)) { continue; }
      least = std::min(least, mean.light[k]);
      most = std::max(most, mean.light[k]);
    }
    const double indirect = sum_of_channels(indirect_[block][own.fragment]);
    if (most - least > change_at_edge * (most + indirect)) { of_[block].next.emplace_back(b, i); }
  });
}

// The fragments of one surface share the list of possible blockers.
HALFLIGHT_INLINE void SmoothShadows::average(std::size_t block) {
  const std::vector<Fragment>& fragments = seen_.of(block);
  std::vector<Asked> all = asked(block);
  const auto surface = [&](const Asked& asked) { return fragments[asked.fragment].place.surface; };
  std::stable_sort(all.begin(), all.end(), [&](const Asked& a, const Asked& b) { return surface(a) < surface(b); });
  for (auto begin = all.begin(), end = begin; begin != all.end(); begin = end) {
    std::vector<FinalGather::Place> places;
    for (; end != all.end() && surface(*end) == surface(*begin); ++end) {
      places.push_back(fragments[end->fragment].place);
      for (const PixelPlace& p : end->few) { places.push_back(p.place); }
      for (const PixelPlace& p : end->many) { places.push_back(p.place); }
    }
    LitRegion region = light_.lit_region(places);
    for (auto one = begin; one != end; ++one) {
      if (blocks_.control().cancelled()) { return; }
      const Color& indirect = indirect_[block][one->fragment];
      const MeanLight mean = one->few.empty() ? mean_light(region, one->many, indirect) : mean_light(region, one->few, one->many, indirect);
      irradiance_[block][one->fragment] = mean.direct + indirect;
      if (!mean.mixed) { continue; }
      of_[block].tested[one->fragment] = Tested::many;
      look_beside(block, *one, mean);
    }
  }
}

HALFLIGHT_INLINE bool SmoothShadows::smooth(double from, double to) {
  const double step = 0.1 * (to - from);
  if (!blocks_.each_block(from, from + step, [&](std::size_t b) { begin(b); })) { return false; }
  if (!blocks_.each_block(from + step, from + 2.0 * step, [&](std::size_t b) { seek(b); })) { return false; }
  double done = from + 2.0 * step;
  do {
    std::vector<std::size_t> waiting;
    for (std::size_t b = 0; b < of_.size(); ++b) {
      if (!of_[b].wanted.empty()) { waiting.push_back(b); }
    }
    const double share = 0.5 * (to - done);  // of the progress; nobody knows how many generations follow
    const auto report = [&](std::size_t count) {
      blocks_.control().report("picture", done + share * static_cast<double>(count) / static_cast<double>(waiting.size()));
    };
    const auto one = [&](std::size_t k) { average(waiting[k]); };
    if (!parallel_in_batches(blocks_.control(), blocks_.threads(), waiting.size(), {512, 4}, one, report) ||
        blocks_.control().cancelled()) {
      return false;
    }
    done += share;
  } while (follow());
  return true;
}

}  // namespace radiosity
