// SPDX-License-Identifier: MIT
#include <radiosity/camera/indirect_light.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

#include <radiosity/scene/batches.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

HALFLIGHT_INLINE FinalGather::Indirect IndirectLight::gathered(const Fragment& fragment, const GatherRays& rays) const {
  const std::uint64_t pixel = blocks_.pixel(fragment.x, fragment.y);
  const std::uint64_t key = scramble(pixel ^ std::uint64_t{rays.least - gather_rays.least} << 32) ^ fragment.place.surface;
  return light_.indirect(fragment.place, rays, key);
}

HALFLIGHT_INLINE IndirectPoint IndirectLight::point_at(const Fragment& fragment, const GatherRays& rays) const {
  constexpr double close = 3.0;  // pixels
  const double pixel_size = seen_.pixel_size()(fragment.place.point.position);
  const bool many_around = contacts_.distance(fragment, close * pixel_size) < close * pixel_size;
  const auto found = gathered(fragment, many_around && rays.least > gather_rays_at_contact.least ? gather_rays_at_contact : rays);
  IndirectPoint point = indirect_point(found, {fragment.x, fragment.y}, fragment.place, seen_.eye().position, pixel_size);
  // The sphere ends where the light may change faster than its rays could tell.
  limit_radius(point, contacts_.distance(fragment, point.radius));
  return point;
}

HALFLIGHT_INLINE bool IndirectLight::gather(double from, double to) {
  std::vector<std::vector<std::uint32_t>> wanted(blocks_.count());  // fragments that need a point, by block
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  std::vector<IndirectPoint> found;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> fragments;  // by point: the block and the fragment in which it lies
  double done = from;
  const double step = (to - from) / 6.0;
  if (!blocks_.each_block(from, from, [&](std::size_t b) { contacts_.find(b); })) { return false; }
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
    if (!blocks_.each_block(done, done + step / 6.0, ask)) { return false; }
    all.clear();
    for (std::uint32_t b = 0; b < wanted.size(); ++b) {
      for (const std::uint32_t i : wanted[b]) { all.emplace_back(b, i); }
    }
    blocks_.take(all.size() * (2 * sizeof(all.front()) + IndirectPoints::bytes_of_point));
    if (blocks_.too_much()) { return false; }
    found.resize(all.size());
    const GatherRays& rays = pass.stride > 1 ? gather_rays : gather_rays_between;
    const auto gather_one = [&](std::size_t k) { found[k] = point_at(seen_.of(all[k].first)[all[k].second], rays); };
    const auto report = [&](std::size_t count) {
      blocks_.control().report("picture", done + 5.0 / 6.0 * step * static_cast<double>(count) / static_cast<double>(all.size()));
    };
    if (!parallel_in_batches(blocks_.control(), blocks_.threads(), all.size(), {1024, 8}, gather_one, report)) { return false; }
    points_.reserve(found.size());
    const std::size_t before = points_.bytes_of_tiles();
    for (const IndirectPoint& point : found) { points_.add(point); }
    blocks_.take(points_.bytes_of_tiles() - before);
    fragments.insert(fragments.end(), all.begin(), all.end());
    done += step;
  }
  const auto again = [&](std::size_t i) { return gathered(seen_.of(fragments[i].first)[fragments[i].second], gather_rays_again); };
  if (!points_.gather_again(blocks_.threads(), blocks_.control(), again)) { return false; }
  const auto fit = [&](std::size_t i) { points_.fit(i); };
  return parallel_in_batches(blocks_.control(), blocks_.threads(), points_.size(), {points_.size(), 64}, fit);
}

HALFLIGHT_INLINE Color IndirectLight::at(const Fragment& f) const {
  return points_.at(f.x, f.y, f.place.point.position, f.place.point.normal, f.place.object).value_or(Color{0.0});
}

}  // namespace radiosity
