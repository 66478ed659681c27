// SPDX-License-Identifier: MIT
#include <radiosity/camera/fragments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <brep/inline.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>

namespace radiosity {

HALFLIGHT_INLINE bool one_piece(const FinalGather::Place& a, const FinalGather::Place& b, const PixelSize& pixel_size) {
  if (a.surface != b.surface || !(glm::dot(a.point.normal, b.point.normal) > 0.97)) { return false; }
  constexpr double apart = 4.0;  // pixels
  return std::abs(glm::dot(a.point.normal, b.point.position - a.point.position)) < apart * pixel_size(a.point.position);
}

HALFLIGHT_INLINE void add_fragments(const FinalGather& light, std::uint32_t x, std::uint32_t y,
                                    std::span<const std::optional<FinalGather::Place>> seen, const PixelSize& pixel_size,
                                    std::vector<Fragment>& out) {
  struct Sums {  // over the rays of a fragment
    glm::dvec3 positions{0.0}, normals{0.0};
  };
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  std::vector<Sums> sums;
  for (const auto& place : seen) {
    if (!place) { continue; }
    const auto same =
        std::find_if(out.begin() + first, out.end(), [&](const Fragment& f) { return one_piece(f.place, *place, pixel_size); });
    if (same == out.end()) {
      out.push_back({x, y, 1.0f, *place});
      sums.push_back({place->point.position, place->point.normal});
    } else {
      Sums& all = sums[static_cast<std::size_t>(same - out.begin() - first)];
      same->share += 1.0f;
      all.positions += place->point.position;
      all.normals += place->point.normal;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const auto f = out.begin() + first + static_cast<std::ptrdiff_t>(k);
    const glm::dvec3 middle = sums[k].positions / static_cast<double>(f->share);
    const bool whole = f->share == static_cast<float>(seen.size());
    f->share /= static_cast<float>(seen.size());
    if (whole && light.objects().object(f->place.object).flat()) {
      f->place.point = {middle, glm::normalize(sums[k].normals)};
      continue;
    }
    // The mean of points on a curved surface lies off the surface, and that of points on both sides of a narrow thing, like the frame of a
    // far window, lies in it or behind it. So the place is the nearest of the points.
    double nearest = raycast::infinity;
    const FinalGather::Place of_piece = f->place;
    for (const auto& place : seen) {
      if (!place || !one_piece(of_piece, *place, pixel_size)) { continue; }
      const double distance = glm::length(place->point.position - middle);
      if (distance < nearest) {
        nearest = distance;
        f->place.point = place->point;
      }
    }
    if (!whole) { continue; }
    // Nothing stands before the whole piece; the point of the surface that is seen in the direction of the mean, unless it bends away.
    const auto in_middle = light.beside(f->place, pixel_size.eye, middle - pixel_size.eye);
    if (in_middle && one_piece(f->place, *in_middle, pixel_size)) { f->place = *in_middle; }
  }
}

namespace detail {

// Rows and columns of a filled block at which shadows are computed: every second or third pixel.
inline constexpr std::array<std::uint32_t, 4> lattice{0, 2, 5, 7};
inline constexpr std::array<std::uint32_t, block_side> cell_of{0, 0, 0, 1,
                                                               1, 1, 2, 2};  // of a coordinate: between lattice[c] and lattice[c + 1]

// Is the shadow of a thin object as thin as the object? The penumbra is as wide as the apparent width of the lamp times the distance of
// the blocker. A blocker nearer than a block's width shows in the block itself, which then is not filled; from there on a wider lamp
// blurs the shadow over some pixels. For a tube, its width decides, because a thin object may lie parallel to it.
HALFLIGHT_INLINE bool is_narrow(const DirectLight::Lamp& lamp, const glm::dvec3& x) {
  constexpr double seems = 0.1;
  return lamp.width < seems * glm::length(lamp.centre - x);
}

// Adds the light of lamp k of the region to the fragments `own`, which are of one surface.
HALFLIGHT_INLINE void add_lamp(LitRegion& region, std::size_t k, std::span<const std::uint32_t> own, const std::vector<Fragment>& fragments,
                               std::vector<Color>& irradiance) {
  const auto point = [&](std::uint32_t i) { return fragments[i].place.point; };
  const auto add = [&](std::uint32_t i, double visible) {
    if (visible > 0.0) { irradiance[i] += region.lamp(k).exitance * (visible * region.unhidden(k, point(i).position, point(i).normal)); }
  };
  const auto visible = [&](std::uint32_t i) { return region.visible(k, point(i).position, point(i).normal, irradiance[i]); };
  const auto all = [&](double share) {
    for (const std::uint32_t i : own) { add(i, share); }
  };
  if (!region.may_be_hidden(k)) { return all(1.0); }
  const auto whole = [&](std::uint32_t i) { return fragments[i].share == 1.0f; };
  const bool filled = own.size() == block_side * block_side && std::all_of(own.begin(), own.end(), whole);
  if (!filled) {
    for (const std::uint32_t i : own) { add(i, visible(i)); }
    return;
  }
  std::array<std::array<double, block_side>, block_side> share{};
  std::array<std::array<std::uint32_t, block_side>, block_side> fragment{};
  for (const std::uint32_t i : own) { fragment[fragments[i].y % block_side][fragments[i].x % block_side] = i; }
  double least = 1.0, most = 0.0;
  for (const std::uint32_t v : lattice) {
    for (const std::uint32_t u : lattice) {
      share[v][u] = visible(fragment[v][u]);
      least = std::min(least, share[v][u]);
      most = std::max(most, share[v][u]);
    }
  }
  constexpr double surely = 1e-6;
  const auto same = [&] { return least >= 1.0 - surely || most <= surely; };
  const bool narrow = is_narrow(region.lamp(k), point(own[0]).position);
  if (narrow && same()) {
    constexpr std::uint32_t last = block_side - 1;
    for (const std::uint32_t w : {1u, 3u, 4u, 6u}) {  // the border pixels that have not been computed yet
      for (const std::uint32_t i : {fragment[w][0], fragment[w][last], fragment[0][w], fragment[last][w]}) {
        const double v = visible(i);
        least = std::min(least, v);
        most = std::max(most, v);
      }
    }
  }
  if (same()) { return all(most <= surely ? 0.0 : 1.0); }
  // Interpolate where the four lattice pixels around agree, unless a thin shadow may pass between them.
  const double agree = narrow ? -1.0 : 0.06;
  for (std::uint32_t v = 0; v < block_side; ++v) {
    for (std::uint32_t u = 0; u < block_side; ++u) {
      const std::uint32_t u0 = lattice[cell_of[u]], u1 = lattice[cell_of[u] + 1], v0 = lattice[cell_of[v]], v1 = lattice[cell_of[v] + 1];
      if ((u == u0 || u == u1) && (v == v0 || v == v1)) { continue; }
      const double a = share[v0][u0], b = share[v0][u1], c = share[v1][u0], d = share[v1][u1];
      const double s = static_cast<double>(u - u0) / (u1 - u0), t = static_cast<double>(v - v0) / (v1 - v0);
      share[v][u] = std::max({a, b, c, d}) - std::min({a, b, c, d}) <= agree
                        ? (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d)
                        : visible(fragment[v][u]);
    }
  }
  for (const std::uint32_t i : own) { add(i, share[fragments[i].y % block_side][fragments[i].x % block_side]); }
}

}  // namespace detail

HALFLIGHT_INLINE void add_direct_light(const FinalGather& light, std::span<const std::uint32_t> own, const std::vector<Fragment>& fragments,
                                       std::vector<Color>& irradiance) {
  std::vector<FinalGather::Place> places;
  for (const std::uint32_t i : own) { places.push_back(fragments[i].place); }
  LitRegion region = light.lit_region(places);
  for (std::size_t k = 0; k < region.size(); ++k) { detail::add_lamp(region, k, own, fragments, irradiance); }
}

}  // namespace radiosity
