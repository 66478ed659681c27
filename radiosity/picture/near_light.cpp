// SPDX-License-Identifier: MIT
#include <radiosity/picture/near_light.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/met.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

struct NearLight::Paths {
  std::array<raycast::ScenePoint, paths_at_once> end;
  std::array<Color, paths_at_once> carried;          // share of the light at the end that returns to the place
  std::array<Color, paths_at_once> light;            // light so far
  std::uint32_t lanes = (1u << paths_at_once) - 1u;  // paths that have not ended

  template <class Body>
  void each(const Body& body) const {
    for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) { body(static_cast<unsigned>(std::countr_zero(rest))); }
  }
};

namespace detail {

// The light that a lamp would send to a place from its centre; lamps are chosen in proportion to it.
[[nodiscard]] HALFLIGHT_INLINE double strength(const DirectLight::Lamp& lamp, const raycast::SurfacePoint& at) {
  const glm::dvec3 d = lamp.centre - at.position;
  if (!(glm::dot(d, at.normal) > -lamp.radius)) { return 0.0; }
  const double size = lamp.radius * lamp.radius;
  return sum_of_channels(lamp.exitance) * size / std::max(glm::dot(d, d), size);
}

struct ChosenLamp {
  const DirectLight::Lamp* lamp = nullptr;
  double probability = 0.0;
};

// The probabilities with which lamps are chosen at a place: mostly by the photons that landed there, otherwise by strength. Strength
// alone would choose lamps behind walls; photons alone might miss a lamp that shines past an edge.
class LampChoice {
 public:
  LampChoice(const DirectLight& direct, const PhotonGrid& photons, const raycast::SurfacePoint& at)
      : lamps_{direct.lamps()}, at_{&at}, by_photons_{photons.around(at.position, at.normal)} {
    for (const DirectLight::Lamp& lamp : lamps_) { strength_ += strength(lamp, at); }
  }

  [[nodiscard]] ChosenLamp of(const DirectLight::Lamp& lamp) const {
    const double by_strength = strength_ > 0.0 ? strength(lamp, *at_) / strength_ : 0.0;
    const auto index = static_cast<std::uint32_t>(&lamp - lamps_.data());
    return {&lamp, (1.0 - by_photons_.trust) * by_strength + by_photons_.trust * by_photons_.share_of(index)};
  }

  // Chooses a lamp by a number in (0, 1).
  [[nodiscard]] ChosenLamp choose(double number) const {
    const double trust = by_photons_.trust;
    if (number < trust) {
      number /= trust;
      return of(lamps_[by_photons_.choose(number)]);
    }
    double left = (number - trust) / (1.0 - trust) * strength_;
    const DirectLight::Lamp* chosen = nullptr;
    for (const DirectLight::Lamp& lamp : lamps_) {
      const double own = strength(lamp, *at_);
      if (!(own > 0.0)) { continue; }
      chosen = &lamp;
      left -= own;
      if (left < 0.0) { break; }
    }
    return chosen != nullptr ? of(*chosen) : ChosenLamp{};
  }

 private:
  std::span<const DirectLight::Lamp> lamps_;
  const raycast::SurfacePoint* at_;
  PhotonGrid::Around by_photons_;
  double strength_ = 0.0;  // sum over all lamps
};

// Density with which a uniform ray from `place` hits this point of the lamp, relative to that of choosing the point (uniformly on the
// lamp).
[[nodiscard]] HALFLIGHT_INLINE double ray_to_chosen(const ChosenLamp& chosen, const raycast::SurfacePoint& place, const glm::dvec3& end,
                                                    const glm::dvec3& normal) {
  const glm::dvec3 d = end - place.position;
  const double here = glm::dot(d, place.normal), there = -glm::dot(d, normal), square = glm::dot(d, d);
  if (!(here > 0.0) || !(there > 0.0)) { return 0.0; }
  return chosen.lamp->area * here * there / (std::numbers::pi * square * square) / chosen.probability;
}

// Weight of a lamp's light that a uniform ray has hit, by the balance heuristic; the rest comes from chosen points.
[[nodiscard]] HALFLIGHT_INLINE double share_of_ray(const LampChoice& choice, const DirectLight::Lamp& lamp,
                                                   const raycast::SurfacePoint& place, const raycast::SurfacePoint& end) {
  const ChosenLamp chosen = choice.of(lamp);
  if (!(chosen.probability > 0.0)) { return 1.0; }
  const double ratio = ray_to_chosen(chosen, place, end.position, end.normal);
  return ratio / (1.0 + ratio);
}

}  // namespace detail

HALFLIGHT_INLINE void NearLight::light_by_lamps(Paths& paths, std::span<PathNumbers> numbers) const {
  const double off_surface = direct_->off_surface();
  raycast::Segments16 segments;
  std::array<Color, paths_at_once> arriving{};
  // Consecutive samples of a lamp are stratified over it, and the paths choose lamps by stratified numbers.
  const double row = numbers[0].uniform(), turn = numbers[0].uniform();
  std::array<detail::ChosenLamp, paths_at_once> choices;
  paths.each([&](unsigned k) {
    const double number = std::fmod(turn + static_cast<double>(k) / paths_at_once, 1.0);
    choices[k] = detail::LampChoice{*direct_, *lamp_photons_, paths.end[k]}.choose(number);
  });
  paths.each([&](unsigned k) {
    const raycast::ScenePoint& at = paths.end[k];
    const detail::ChosenLamp& chosen = choices[k];
    if (chosen.lamp == nullptr) { return; }
    const std::vector<LampSample>& samples = chosen.lamp->samples;
    // Starts at a random sample of a row and wraps around, so that few paths with the same lamp do not all use the first samples.
    const auto any = static_cast<std::size_t>(row * static_cast<double>(samples.size()));
    const auto before = std::count_if(choices.begin(), choices.begin() + k, [&](const auto& c) { return c.lamp == chosen.lamp; });
    const std::size_t in_row = (any + static_cast<std::size_t>(before)) % paths_at_once;
    const LampSample& sample = samples[any - any % paths_at_once + in_row];
    const double ratio = detail::ray_to_chosen(chosen, at, sample.position, sample.normal);
    if (!(ratio > 0.0)) { return; }
    arriving[k] = chosen.lamp->exitance * (ratio / (1.0 + ratio));
    const double lift = direct_->lift(at.object);
    const bool curved = !(lift > 0.0) && !lookup_->objects().object(at.object).flat();
    const glm::dvec3 from = lift > 0.0 ? direct_->lifted(at.object, at.position, at.normal) : at.position + off_surface * at.normal;
    const glm::dvec3 to = sample.position + (sample.end.owner == raycast::no_object ? off_surface : 0.0) * sample.normal;
    segments.set(k, {from, to - from}, curved ? at.object : raycast::no_object, sample.end.owner);
  });
  if (segments.lanes == 0) { return; }
  const std::uint32_t lit = segments.lanes & ~direct_->objects().occluded16(segments);
  for (unsigned k = 0; k < paths_at_once; ++k) {
    if (lit >> k & 1u) { paths.light[k] += paths.carried[k] * arriving[k]; }
  }
}

HALFLIGHT_INLINE void NearLight::light_by_spots(Paths& paths, std::span<PathNumbers> numbers, const BrightSpots::From& spots,
                                                bool last) const {
  raycast::Segments16 rays;
  std::array<BrightSpots::Target, paths_at_once> targets;
  paths.each([&](unsigned k) {
    const raycast::ScenePoint& at = paths.end[k];
    const double u0 = numbers[k].uniform(), u1 = numbers[k].uniform(), u2 = numbers[k].uniform();
    targets[k] = spots.choose({u0, u1, u2, 0.5});
    const glm::dvec3 d = targets[k].at.position - at.position;
    if (!(glm::dot(d, at.normal) > 0.0) || !(glm::dot(d, targets[k].at.normal) < 0.0)) { return; }
    const double lift = direct_->lift(at.object), reach = lookup_->objects().diameter();
    rays.set(k, {at.position + lift * at.normal, reach * glm::normalize(d)}, lift > 0.0 ? raycast::no_object : at.object,
             raycast::no_object, at.sheet);
  });
  if (rays.lanes == 0) { return; }
  const raycast::Hits16 hits = direct_->objects().closest16(rays);
  for (std::uint32_t rest = hits.met & rays.lanes; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(rest));
    const raycast::Hit& hit = hits.hit[k];
    if (!hit.front || direct_->whole(hit.object) != targets[k].at.object) { continue; }
    const raycast::ScenePoint& at = paths.end[k];
    const raycast::ScenePoint& next = targets[k].at;
    if (!BrightSpots::reached(*direct_, next, at.position, met(lookup_->objects(), *direct_, hit, rays.at(k)))) { continue; }
    const std::optional<Lookup::Found> found = spots.found(targets[k]);
    if (!found || (!last && glm::length(next.position - at.position) < found->coarse_within)) { continue; }
    const std::uint32_t surface = lookup_->surface(next.object, next.sheet);
    const double aimed = spots.aimed(surface, *found, at, next);
    const Color lamp = direct_->is_lamp(surface) ? (*materials_)[surface].emission : Color{0.0};
    if (aimed > 0.0) { paths.light[k] += paths.carried[k] * (found->radiosity - lamp) / (1.0 + aimed); }
  }
}

HALFLIGHT_INLINE void NearLight::go_on(Paths& paths, std::span<PathNumbers> numbers, const BrightSpots::From* spots, bool last) const {
  const double reach = lookup_->objects().diameter();
  raycast::Segments16 rays;
  paths.each([&](unsigned k) {
    const raycast::ScenePoint& at = paths.end[k];
    const double lift = direct_->lift(at.object), u = numbers[k].uniform();
    const glm::dvec3 direction = cosine_direction(at.normal, u, numbers[k].uniform());
    rays.set(k, {at.position + lift * at.normal, reach * direction}, lift > 0.0 ? raycast::no_object : at.object, raycast::no_object,
             at.sheet);
  });
  const raycast::Hits16 hits = direct_->objects().closest16(rays);
  paths.lanes &= hits.met;
  paths.each([&](unsigned k) {
    const raycast::Hit& hit = hits.hit[k];
    const std::uint32_t own = 1u << k;
    if (!hit.front) {
      paths.lanes &= ~own;
      return;
    }
    const raycast::ScenePoint next = met(lookup_->objects(), *direct_, hit, rays.at(k));
    const std::uint32_t surface = lookup_->surface(next.object, next.sheet);
    const Material& material = (*materials_)[surface];
    const DirectLight::Lamp* met_lamp = direct_->lamp_of(surface);
    const Color lamp = met_lamp != nullptr ? material.emission : Color{0.0};
    if (met_lamp != nullptr) {
      const detail::LampChoice choice{*direct_, *lamp_photons_, paths.end[k]};
      paths.light[k] += paths.carried[k] * lamp * detail::share_of_ray(choice, *met_lamp, paths.end[k], next);
    }
    const std::optional<Lookup::Found> found = lookup_->find(next);
    if (found && !last && hit.t * reach < found->coarse_within) {
      paths.light[k] += paths.carried[k] * (material.emission - lamp);
      paths.carried[k] *= material.reflectance;
      paths.end[k] = next;
      return;
    }
    if (found) {
      const double aimed = spots != nullptr ? spots->aimed(surface, *found, paths.end[k], next) : 0.0;
      paths.light[k] += paths.carried[k] * (found->radiosity - lamp) / (1.0 + aimed);
    }
    paths.lanes &= ~own;
  });
}

HALFLIGHT_INLINE NearLight::Sum NearLight::light(std::span<const Seen> seen, std::uint32_t paths, std::uint64_t key,
                                                 const BrightSpots::From* spots) const {
  constexpr int most_reflections = 3;
  double all = 0.0;
  for (const Seen& place : seen) { all += sum_of_channels(place.light); }
  if (!(all > 0.0)) { return {}; }
  // Half of the probability follows the light shown by the mesh; the other half is uniform, because a place that the mesh shows
  // dark may be bright.
  const auto probability = [&](const Seen& place) {
    return 0.5 * sum_of_channels(place.light) / all + 0.5 / static_cast<double>(seen.size());
  };
  const Sobol4 first{3, key}, second{4, key};
  const double start = Random{5, key}.uniform();
  Color sum{0.0};
  double squares = 0.0;
  for (std::uint32_t done = 0; done < paths; done += paths_at_once) {
    Paths next;
    std::vector<PathNumbers> numbers;
    std::array<double, paths_at_once> chosen{};  // by path: the probability of its place
    // Systematic sampling: places at even steps of the cumulative probability.
    const double offset = std::fmod(start + done / paths_at_once * std::numbers::phi, 1.0);
    std::size_t place = 0;
    double until = probability(seen[0]);
    for (unsigned k = 0; k < paths_at_once; ++k) {
      const double wanted = (k + offset) / paths_at_once;
      while (until <= wanted && place + 1 < seen.size()) { until += probability(seen[++place]); }
      chosen[k] = probability(seen[place]);
      const raycast::ScenePoint& at = seen[place].at;
      const std::uint32_t surface = lookup_->surface(at.object, at.sheet);
      next.end[k] = at;
      next.carried[k] = (*materials_)[surface].reflectance;
      next.light[k] = direct_->is_lamp(surface) ? Color{0.0} : (*materials_)[surface].emission;
      numbers.emplace_back(first, second, done + k, Random{6, key, done + k});
    }
    for (int reflections = 1; next.lanes != 0; ++reflections) {
      light_by_lamps(next, numbers);
      const bool last = reflections == most_reflections;
      if (spots != nullptr) { light_by_spots(next, numbers, *spots, last); }
      go_on(next, numbers, spots, last);
    }
    for (unsigned k = 0; k < paths_at_once; ++k) {
      const Color part = next.light[k] / chosen[k];
      sum += part;
      squares += sum_of_channels(part) * sum_of_channels(part);
    }
  }
  const double n = paths, mean = sum_of_channels(sum) / n;
  return {sum / n, std::max(0.0, squares / n - mean * mean) / n};
}

}  // namespace radiosity
