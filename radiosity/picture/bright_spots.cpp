// SPDX-License-Identifier: MIT
#include <radiosity/picture/bright_spots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/chord.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::uint32_t no_spot = 0xffffffff;
// What reflects so much more than all surfaces do in the mean is a spot.
inline constexpr double least_contrast = 4.0;
// Of those that a point sends out evenly, about.
inline constexpr double even_rays = 256.0;
// Each takes some operations a point; a point sends hundreds of rays.
inline constexpr std::size_t most_groups = 128;

// The area of what a triangle stands for: that of four triangles whose new corners are on the surface, and a third of what these add, for
// the error of a chord falls by four.
[[nodiscard]] HALFLIGHT_INLINE double true_area(const raycast::PlacedObject& object, std::uint32_t sheet, const ChordTriangle& triangle) {
  const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
  };
  const auto& [a, b, c] = triangle.position;
  const double flat = area(a, b, c);
  if (object.flat()) { return flat; }
  const auto middle = [&](const glm::dvec3& p, const glm::dvec3& q) { return object.project(sheet, 0.5 * (p + q)).position; };
  const glm::dvec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  const double finer = area(a, ab, ca) + area(b, bc, ab) + area(c, ca, bc) + area(ab, bc, ca);
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
        spot.power = spot.area * (light.x + light.y + light.z);
        const double length = glm::length(spot.normal);
        if (!(length > 0.0) || !(spot.area > 0.0)) { continue; }
        spot.normal /= length;
        area += spot.area;
        power += spot.power;
        if (!(direct.lift(o) > 0.0)) { spots_.push_back(spot); }
      }
    }
  }
  std::erase_if(spots_, [&](const Spot& spot) { return !(spot.power * area > detail::least_contrast * power * spot.area); });
  if (!spots_.empty()) { make_groups(); }
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
  std::priority_queue<std::pair<double, std::uint32_t>> open;  // worth of a cut, group
  const auto enter = [&](std::uint32_t g) {
    const Group& group = groups_[g];
    if (group.last - group.first > 1) { open.emplace(group.power * group.radius * (1.5 - glm::length(group.normal)), g); }
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
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    double before = 0.0;
    for (std::uint32_t i = groups_[g].first; i < groups_[g].last; ++i) {
      Spot& spot = spots_[i];
      spot.group = g;
      before = spot.until = before + spot.power;
      spot_of_[lookup_->surface(spot.object, spot.sheet)][spot.triangle] = i;
    }
  }
}

HALFLIGHT_INLINE BrightSpots::From::From(const BrightSpots& spots, const glm::dvec3& position, const glm::dvec3* normal) : spots_{&spots} {
  until_.reserve(spots.groups_.size());
  double sum = 0.0;
  for (const Group& group : spots.groups_) {
    const glm::dvec3 d = group.middle - position;
    const double square = glm::dot(d, d) + group.radius * group.radius, length = std::sqrt(square);
    const double here = normal == nullptr ? 1.0 : std::clamp((glm::dot(d, *normal) + group.radius) / length, 0.0, 1.0);
    const double spread = 1.0 - glm::length(group.normal);
    const double there = std::clamp((group.radius - glm::dot(d, group.normal)) / length + spread, 0.0, 1.0);
    const double light = group.power * here * there / (std::numbers::pi * square);
    sum += light;
    until_.push_back(sum);
    square_ += light * group.radiosity;
    factor_ += light / group.radiosity;
  }
}

HALFLIGHT_INLINE bool BrightSpots::From::stand_out(double light, double visible) const {
  const double meeting = detail::even_rays * visible * factor_;  // rays lie evenly: of what many of them meet only the border is noise
  return visible * square_ > light * light * std::sqrt(1.0 + meeting);
}

HALFLIGHT_INLINE BrightSpots::Target BrightSpots::From::choose(const std::array<double, 4>& numbers) const {
  const double at = numbers[0] * until_.back();
  const auto g = static_cast<std::size_t>(std::upper_bound(until_.begin(), until_.end() - 1, at) - until_.begin());
  const Group& group = spots_->groups_[g];
  const double before = g > 0 ? until_[g - 1] : 0.0;
  const double rest = (at - before) / (until_[g] - before) * group.power;
  const auto first = spots_->spots_.begin() + group.first, last = spots_->spots_.begin() + group.last;
  const Spot& spot = *std::upper_bound(first, last - 1, rest, [](double value, const Spot& s) { return value < s.until; });
  const std::uint32_t surface = spots_->lookup_->surface(spot.object, spot.sheet);
  const auto& [a, b, c] = spots_->lookup_->triangle(surface, spot.triangle).position;
  const double root = std::sqrt(numbers[1]), v = numbers[2];
  const glm::dvec3 chord = (1.0 - root) * a + root * (1.0 - v) * b + root * v * c;
  return {spots_->lookup_->objects().object(spot.object).project(spot.sheet, chord), spot.object, spot.sheet};
}

HALFLIGHT_INLINE double BrightSpots::From::density(std::uint32_t surface, std::uint32_t triangle) const {
  const std::uint32_t i = spots_->spot_of_[surface][triangle];
  if (i == detail::no_spot) { return 0.0; }
  const Spot& spot = spots_->spots_[i];
  const double light = until_[spot.group] - (spot.group > 0 ? until_[spot.group - 1] : 0.0);
  return light / until_.back() * spot.power / spots_->groups_[spot.group].power / spot.area;
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
