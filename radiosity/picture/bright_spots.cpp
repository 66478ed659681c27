// SPDX-License-Identifier: MIT
#include <radiosity/picture/bright_spots.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/chord.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/met.hpp>
#include <radiosity/picture/spot_photons.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::uint32_t no_spot = 0xffffffff;
// A surface counts as a spot if it reflects this many times as much as the mean of all surfaces without brighter spots. These are removed
// from the mean in rounds, because a housing with a lamp inside may hold most of the light and let little of it out; a lit strip of wall
// would not stand out beside it.
inline constexpr double least_contrast = 4.0;
inline constexpr int most_rounds = 8;
// Approximate number of uniform rays that a point sends.
inline constexpr double even_rays = 512.0;
// Limit, because each group costs some operations per point; a point sends hundreds of rays.
inline constexpr std::size_t most_groups = 128;
// Number of photons that should land outside the spots, limit of the number sent, and size of a batch.
inline constexpr std::uint32_t wanted_photons = 1u << 13, most_photons = 1u << 16, photons_at_once = 1u << 12;
inline constexpr double photon_reach = 0.1;  // relative to the diameter of the scene
// Weight of the unoccluded light of the spots, compared with the photons around a point; in photons.
inline constexpr double unhidden_photons = 12.0;

// The area of the surface above a triangle: that of four triangles whose new corners lie on the surface, plus a third of the difference
// to the flat triangle, because the error of a chord falls to a quarter.
[[nodiscard]] HALFLIGHT_INLINE double true_area(const raycast::PlacedObject& object, std::uint32_t sheet, const ChordTriangle& triangle) {
  const auto& [a, b, c] = triangle.position;
  const double flat = triangle_area(a, b, c);
  if (object.flat()) { return flat; }
  const auto middle = [&](const glm::dvec3& p, const glm::dvec3& q) { return object.project(sheet, 0.5 * (p + q)).position; };
  const glm::dvec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  const double finer = triangle_area(a, ab, ca) + triangle_area(b, bc, ab) + triangle_area(c, ca, bc) + triangle_area(ab, bc, ca);
  return finer + (finer - flat) / 3.0;
}

}  // namespace detail

HALFLIGHT_INLINE BrightSpots::BrightSpots(const Lookup& lookup, const DirectLight& direct, std::span<const Color> apart)
    : lookup_{&lookup}, spot_of_(apart.size()) {
  double area = 0.0, power = 0.0;
  for (std::uint32_t o = 0; o < lookup.objects().size(); ++o) {
    const raycast::PlacedObject& object = lookup.objects().object(o);
    for (std::uint32_t s = 0; s < object.sheet_count(); ++s) {
      const std::uint32_t surface = lookup.surface(o, s);
      const auto count = static_cast<std::uint32_t>(lookup.triangle_count(surface));
      spot_of_[surface].assign(count, detail::no_spot);
      for (std::uint32_t k = 0; k < count; ++k) {
        const ChordTriangle triangle = lookup.triangle(surface, k);
        const auto& [a, b, c] = triangle.position;
        const Color light = lookup.mean(surface, k) - apart[surface];
        Spot spot;
        spot.object = o, spot.sheet = s, spot.triangle = k;
        spot.middle = (a + b + c) / 3.0;
        spot.normal = glm::cross(b - a, c - a);
        spot.area = detail::true_area(object, s, triangle);
        spot.power = spot.area * sum_of_channels(light);
        const double length = glm::length(spot.normal);
        if (!(length > 0.0) || !(spot.area > 0.0)) { continue; }
        spot.normal /= length;
        area += spot.area;
        power += spot.power;
        spots_.push_back(spot);
      }
    }
  }
  auto last = spots_.end();  // spots are the elements from here on
  // Once the rest is black its power is a rounding error, of either sign: below a negative one everything black would count as a spot.
  for (int round = 0; round < detail::most_rounds && area > 0.0 && power > 0.0; ++round) {
    const double least = detail::least_contrast * power / area;
    const auto first = std::stable_partition(spots_.begin(), last, [&](const Spot& spot) { return !(spot.power > least * spot.area); });
    if (first == last) { break; }
    for (auto spot = first; spot != last; ++spot) {
      area -= spot->area;
      power -= spot->power;
    }
    last = first;
  }
  spots_.erase(spots_.begin(), last);
  if (spots_.empty()) { return; }
  make_groups();
  send_photons(direct);
}

HALFLIGHT_INLINE BrightSpots::Group BrightSpots::group_of(std::uint32_t first, std::uint32_t last) const {
  Group group{first, last};
  double squares = 0.0;
  for (std::uint32_t i = first; i < last; ++i) {
    const Spot& spot = spots_[i];
    group.power += spot.power;
    group.middle += spot.power * spot.middle;
    group.normal += spot.power * spot.normal;
    group.radiosity += spot.power * spot.power / spot.area;
  }
  group.middle /= group.power;
  group.normal /= group.power;
  group.radiosity /= group.power;
  for (std::uint32_t i = first; i < last; ++i) {
    const Spot& spot = spots_[i];
    const glm::dvec3 d = spot.middle - group.middle;
    squares += spot.power * (glm::dot(d, d) + 0.25 * spot.area);
  }
  group.radius = std::sqrt(squares / group.power);
  return group;
}

HALFLIGHT_INLINE std::uint32_t BrightSpots::cut(const Group& group) {
  glm::dvec3 apart{0.0}, turned{0.0};
  for (std::uint32_t i = group.first; i < group.last; ++i) {
    const glm::dvec3 d = spots_[i].middle - group.middle, n = group.radius * (spots_[i].normal - group.normal);
    apart += spots_[i].power * d * d;
    turned += spots_[i].power * n * n;
  }
  const std::array<double, 6> spread{apart.x, apart.y, apart.z, turned.x, turned.y, turned.z};
  const auto axis = static_cast<int>(std::max_element(spread.begin(), spread.end()) - spread.begin());
  const auto along = [&](const glm::dvec3& place, const glm::dvec3& normal) { return axis < 3 ? place[axis] : normal[axis - 3]; };
  const auto at = [&](const Spot& spot) { return along(spot.middle, spot.normal); };
  std::stable_sort(spots_.begin() + group.first, spots_.begin() + group.last, [&](const Spot& a, const Spot& b) { return at(a) < at(b); });
  const double middle = along(group.middle, group.normal);
  std::uint32_t second = group.first + 1;
  while (second + 1 < group.last && at(spots_[second]) < middle) { ++second; }
  return second;
}

HALFLIGHT_INLINE void BrightSpots::make_groups() {
  std::priority_queue<std::pair<double, std::uint32_t>> open;  // benefit of splitting, group
  const auto enter = [&](std::uint32_t g) {
    const Group& group = groups_[g];
    if (group.last - group.first > 1) { open.emplace(std::sqrt(group.power) * group.radius * (1.5 - glm::length(group.normal)), g); }
  };
  groups_.push_back(group_of(0, static_cast<std::uint32_t>(spots_.size())));
  enter(0);
  while (!open.empty() && groups_.size() < detail::most_groups) {
    const std::uint32_t g = open.top().second;
    open.pop();
    const Group old = groups_[g];
    const std::uint32_t second = cut(old);
    groups_[g] = group_of(old.first, second);
    groups_.push_back(group_of(second, old.last));
    enter(g);
    enter(static_cast<std::uint32_t>(groups_.size() - 1));
  }
  std::vector<std::uint32_t> order(groups_.size());  // of the groups along the spots
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return groups_[a].first < groups_[b].first; });
  for (const std::uint32_t g : order) {
    double before = 0.0;
    for (std::uint32_t i = groups_[g].first; i < groups_[g].last; ++i) {
      Spot& spot = spots_[i];
      spot.group = g;
      before = spot.until = before + spot.power;
      const std::uint32_t surface = lookup_->surface(spot.object, spot.sheet);
      spot_of_[surface][spot.triangle] = i;
      until_.push_back(spot.until);
      corners_.push_back(lookup_->triangle(surface, spot.triangle).position);
    }
  }
}

HALFLIGHT_INLINE BrightSpots::Chosen BrightSpots::group_at(std::span<const double> until, double number) {
  const std::size_t g = drawn_index(until, number);
  const double before = g > 0 ? until[g - 1] : 0.0;
  return {g, (number - before) / (until[g] - before)};
}

HALFLIGHT_INLINE std::uint32_t BrightSpots::spot_at(const Group& group, double number) const {
  const std::span<const double> until = std::span(until_).subspan(group.first, group.last - group.first);
  return group.first + static_cast<std::uint32_t>(drawn_index(until, number * group.power));
}

HALFLIGHT_INLINE BrightSpots::Target BrightSpots::point_of(std::uint32_t index, double u, double v) const {
  const Spot& spot = spots_[index];
  const auto& [a, b, c] = corners_[index];
  const glm::dvec3 weight = triangle_weights(u, v), chord = triangle_point(weight, a, b, c);
  return {{lookup_->objects().object(spot.object).project(spot.sheet, chord), spot.object, spot.sheet}, index, weight};
}

HALFLIGHT_INLINE std::optional<Lookup::Found> BrightSpots::found(const Target& target) const {
  if (!lookup_->objects().object(target.at.object).flat()) { return lookup_->find(target.at); }
  return lookup_->found(lookup_->surface(target.at.object, target.at.sheet), spots_[target.spot].triangle, target.weight);
}

HALFLIGHT_INLINE bool BrightSpots::reached(const DirectLight& direct, const raycast::ScenePoint& target, const glm::dvec3& from,
                                           const raycast::ScenePoint& met) {
  if (met.object != target.object || met.sheet != target.sheet) { return false; }
  const glm::dvec3 off = met.position - target.position, d = target.position - from;
  const double lift = direct.lift(target.object);
  if (lift > 0.0) { return std::abs(glm::dot(off, target.normal)) <= 4.0 * lift; }
  return glm::dot(off, off) <= 1e-6 * glm::dot(d, d);
}

HALFLIGHT_INLINE void BrightSpots::send16(const DirectLight& direct, std::uint32_t first, const std::vector<double>& until,
                                          Photons& photons) const {
  const Sobol4 sequence{7};
  const double reach = lookup_->objects().diameter();
  raycast::Segments16 rays;
  std::array<std::uint32_t, 16> group{};
  for (unsigned k = 0; k < 16; ++k) {
    const std::array<double, 4> u = sequence(first + k);
    const auto [g, rest] = group_at(until, u[0]);
    const std::uint32_t index = spot_at(groups_[g], rest);
    const Spot& spot = spots_[index];
    // Position within the spot's interval, reused as the fourth random number.
    const double left = (rest * groups_[g].power - (spot.until - spot.power)) / spot.power;
    const raycast::ScenePoint from = point_of(index, u[3], std::clamp(left, 0.0, 1.0)).at;
    const double lift = direct.lift(from.object);  // the true surface may lie behind the mesh that stands in for it
    const glm::dvec3 above = direct.lifted(from.object, from.position, from.normal);
    rays.set(k, {above, reach * cosine_direction(from.normal, u[1], u[2])}, lift > 0.0 ? raycast::no_object : from.object,
             raycast::no_object, from.sheet);
    group[k] = static_cast<std::uint32_t>(g);
    ++photons.sent[g];
  }
  const raycast::Hits16 hits = direct.objects().closest16(rays);
  for (std::uint32_t rest = hits.met; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(rest));
    if (!hits.hit[k].front) { continue; }
    const raycast::ScenePoint at = met(lookup_->objects(), direct, hits.hit[k], rays.at(k));
    const auto found = lookup_->find(at);
    const bool on_spot = found && spot_of_[lookup_->surface(at.object, at.sheet)][found->triangle] != detail::no_spot;
    photons.elsewhere[group[k]] += on_spot ? 0 : 1;
    photons.landed.push_back({at.position, at.normal, group[k], 0.0});
  }
}

HALFLIGHT_INLINE void BrightSpots::send_photons(const DirectLight& direct) {
  Photons photons{std::vector<std::uint32_t>(groups_.size(), 0), std::vector<std::uint32_t>(groups_.size(), 0), {}};
  std::uint32_t sent = 0, elsewhere = 0;
  while (sent < detail::most_photons && elsewhere < detail::wanted_photons) {
    // A group in a housing, most of whose light goes to other spots, sends fewer photons: in proportion to the square root of the share
    // that gets out, which minimizes the variance for a given number of photons (Neyman 1934).
    std::vector<double> until;
    double all = 0.0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      until.push_back(all += groups_[g].power * std::sqrt((photons.elsewhere[g] + 1.0) / (photons.sent[g] + 1.0)));
    }
    for (double& u : until) { u /= all; }
    for (const std::uint32_t end = sent + detail::photons_at_once; sent < end; sent += 16) { send16(direct, sent, until, photons); }
    elsewhere = std::accumulate(photons.elsewhere.begin(), photons.elsewhere.end(), 0u);
  }
  for (SpotPhotons::Photon& photon : photons.landed) { photon.power = groups_[photon.group].power / photons.sent[photon.group]; }
  photons_ = SpotPhotons{std::move(photons.landed), detail::photon_reach * lookup_->objects().diameter()};
}

HALFLIGHT_INLINE double BrightSpots::From::unhidden(const glm::dvec3& position, const glm::dvec3* normal,
                                                    std::vector<double>& light) const {
  double sum = 0.0;
  for (const Group& group : spots_->groups_) {
    const glm::dvec3 d = group.middle - position;
    const double square = glm::dot(d, d) + group.radius * group.radius, length = std::sqrt(square);
    const double here = normal == nullptr ? 1.0 : std::clamp((glm::dot(d, *normal) + group.radius) / length, 0.0, 1.0);
    const double spread = 1.0 - glm::length(group.normal);
    const double there = std::clamp((group.radius - glm::dot(d, group.normal)) / length + spread, 0.0, 1.0);
    light.push_back(group.power * here * there / (std::numbers::pi * square));
    sum += light.back();
  }
  return sum;
}

HALFLIGHT_INLINE BrightSpots::From::From(const BrightSpots& spots, const glm::dvec3& position, const glm::dvec3* normal) : spots_{&spots} {
  if (spots.empty()) { return; }
  std::vector<double> weight;
  const double all = unhidden(position, normal, weight);
  const SpotPhotons::Found found = spots.photons_.around(position, normal);
  double landed = 0.0;
  for (const std::uint32_t i : found.photons) { landed += spots.photons_[i].power; }
  for (double& w : weight) { w *= all > 0.0 ? detail::unhidden_photons / all : 0.0; }
  const double count = static_cast<double>(found.photons.size());
  // Brightest first: rays are stratified over all regions that are as bright or brighter, so borders within darker regions do not add
  // variance.
  std::vector<std::pair<double, double>> bright;  // radiosity of the photon's group, irradiance by this photon
  for (const std::uint32_t i : found.photons) {
    const SpotPhotons::Photon& photon = spots.photons_[i];
    weight[photon.group] += count * photon.power / landed;
    bright.emplace_back(spots.groups_[photon.group].radiosity, photon.power / (std::numbers::pi * found.radius * found.radius));
  }
  std::sort(bright.begin(), bright.end(), std::greater<>{});
  double factor = 0.0;  // share of uniform rays that meet a spot at least as bright
  for (const auto& [radiosity, light] : bright) {
    factor += light / radiosity;
    square_ += light * radiosity;
    border_ += light * radiosity / std::sqrt(1.0 + detail::even_rays * factor);
  }
  double sum = 0.0;
  for (const double w : weight) { until_.push_back(sum += w); }
  for (double& until : until_) { until /= sum; }
}

HALFLIGHT_INLINE double BrightSpots::From::contrast(double light) const { return border_ > 0.0 ? std::sqrt(border_) / light : 0.0; }

HALFLIGHT_INLINE BrightSpots::Target BrightSpots::From::choose(const std::array<double, 4>& numbers) const {
  const auto [g, rest] = group_at(until_, numbers[0]);
  return spots_->point_of(spots_->spot_at(spots_->groups_[g], rest), numbers[1], numbers[2]);
}

HALFLIGHT_INLINE double BrightSpots::From::density(std::uint32_t surface, std::uint32_t triangle) const {
  const std::uint32_t i = spots_->spot_of_[surface][triangle];
  if (i == detail::no_spot) { return 0.0; }
  const Spot& spot = spots_->spots_[i];
  const double group = until_[spot.group] - (spot.group > 0 ? until_[spot.group - 1] : 0.0);
  return group * spot.power / spots_->groups_[spot.group].power / spot.area;
}

HALFLIGHT_INLINE double BrightSpots::From::aimed(std::uint32_t surface, const Lookup::Found& found, const raycast::SurfacePoint& here,
                                                 const raycast::SurfacePoint& there) const {
  const double density = found.within ? this->density(surface, found.triangle) : 0.0;
  if (!(density > 0.0)) { return 0.0; }
  const glm::dvec3 d = there.position - here.position;
  const double leaving = glm::dot(d, here.normal), arriving = -glm::dot(d, there.normal), square = glm::dot(d, d);
  return leaving > 0.0 && arriving > 0.0 ? density * std::numbers::pi * square * square / (leaving * arriving) : 0.0;
}

}  // namespace radiosity
