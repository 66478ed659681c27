// SPDX-License-Identifier: MIT
#include <radiosity/visibility/target_lines.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

// The lines run at 0.55 radians to the first edge that has a length, so that they are not parallel to the edges of a rectangle or of a
// regular polygon, nor to the edges of what hangs or stands parallel to it.
HALFLIGHT_INLINE TargetLines::TargetLines(std::span<const glm::dvec3> target, const glm::dvec3& m)
    : target_{target.begin(), target.end()}, origin_{target[0]} {
  constexpr double angle = 0.55;
  const auto apart = [&](const glm::dvec3& p) { return glm::length(p - target[0]) > 0.0; };
  const glm::dvec3 edge = glm::normalize(*std::find_if(target.begin(), target.end(), apart) - target[0]), inwards = glm::cross(m, edge);
  along_ = std::cos(angle) * edge + std::sin(angle) * inwards;
  across_ = glm::cross(m, along_);
  for (std::size_t i = 0; i < target.size(); ++i) {
    const glm::dvec3 &a = target[i], &b = target[i + 1 < target.size() ? i + 1 : 0];
    sides_.push_back({a, glm::cross(m, b - a)});
  }
  sides_.push_back({});
}

HALFLIGHT_INLINE TargetLines::Intervals TargetLines::within(std::span<const HalfSpace> planes) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Intervals part;
  part.low.fill(-infinity);
  part.high.fill(infinity);
  for (const HalfSpace& plane : planes) {
    // Its height is linear: at the origin of a line `start` + at_[k] * `across`, and along the line `slope` a unit.
    const double start = plane.height(origin_), across = glm::dot(plane.normal, across_), slope = glm::dot(plane.normal, along_);
    const double first = -start / slope, further = -across / slope;  // where line k meets the plane: first + further * at_[k]
    if (slope > 0.0) {
      for (std::size_t k = 0; k < count; ++k) { part.low[k] = std::max(part.low[k], first + further * at_[k]); }
    } else if (slope < 0.0) {
      for (std::size_t k = 0; k < count; ++k) { part.high[k] = std::min(part.high[k], first + further * at_[k]); }
    } else {
      for (std::size_t k = 0; k < count; ++k) {
        if (start + across * at_[k] < 0.0) { part.high[k] = -infinity; }
      }
    }
  }
  return part;
}

HALFLIGHT_INLINE void TargetLines::look(const glm::dvec3& x, const glm::dvec3& n) {
  x_ = x;
  n_ = n;
  sides_.back() = {x, n};
  // The lines are spread over what is above the horizon, so that none of it is too narrow for them.
  detail::part(target_, sides_.back(), above_, below_);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const glm::dvec3& p : above_) {
    low = std::min(low, glm::dot(p - origin_, across_));
    high = std::max(high, glm::dot(p - origin_, across_));
  }
  open_lines_ = 0;
  for (auto& visible : visible_) { visible.clear(); }
  all_ = {};
  if (!(low < high)) { return; }
  distance_ = (high - low) / count;
  for (std::size_t k = 0; k < count; ++k) { at_[k] = low + distance_ * (static_cast<double>(k) + 0.5); }
  constexpr double rounding = 1e-12;  // shadows of neighbouring triangles leave such gaps between them
  least_ = rounding * (high - low);
  all_ = within(sides_);
  for (std::size_t k = 0; k < count; ++k) {
    if (all_.high[k] - all_.low[k] > least_) {
      visible_[k].push_back({all_.low[k], all_.high[k]});
      ++open_lines_;
    }
  }
}

HALFLIGHT_INLINE void TargetLines::hide(std::span<const HalfSpace> cone) {
  const Intervals shadow = within(cone);
  for (std::size_t k = 0; k < count; ++k) {
    const double low = shadow.low[k], high = shadow.high[k];
    auto& visible = visible_[k];
    if (visible.empty() || !(low < high) || low >= visible[visible.size() - 1].high || high <= visible[0].low) { continue; }
    brep::SmallList<Interval, 8> rest;
    for (const Interval& open : visible) {
      const Interval before{open.low, std::min(open.high, low)}, behind{std::max(open.low, high), open.high};
      if (before.high - before.low > least_) { rest.push_back(before); }
      if (behind.high - behind.low > least_) { rest.push_back(behind); }
    }
    visible = rest;
    if (visible.empty()) { --open_lines_; }
  }
}

HALFLIGHT_INLINE double TargetLines::light_from(std::size_t k, const Interval& part) const {
  const glm::dvec3 start = origin_ + at_[k] * across_ - x_;
  // The light changes over a distance as long as that to x, so panels are no longer than it, but for points close to the target.
  const double foot = std::clamp(-glm::dot(start, along_), part.low, part.high);
  const double away = glm::length(start + foot * along_), length = part.high - part.low;
  constexpr double most_panels = 16.0;
  const double panels = std::clamp(std::ceil(length / away), 1.0, most_panels);
  constexpr double nodes[3] = {0.1127016653792583, 0.5, 0.8872983346207417}, weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (double p = 0.0; p < panels; p += 1.0) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 d = start + (part.low + length * (p + nodes[i]) / panels) * along_;
      const double square = glm::dot(d, d);
      sum += weights[i] * std::max(0.0, glm::dot(n_, d)) / (square * square);  // the distance to the plane is the same everywhere
    }
  }
  return sum * length / panels;
}

HALFLIGHT_INLINE double TargetLines::visible_share() const {
  double all = 0.0, visible = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Interval whole{all_.low[k], all_.high[k]};
    if (!(whole.high - whole.low > least_)) { continue; }
    const double line = light_from(k, whole);
    all += line;
    const auto& open = visible_[k];
    if (open.size() == 1 && open[0].low == whole.low && open[0].high == whole.high) {
      visible += line;
      continue;
    }
    for (const Interval& part : open) { visible += light_from(k, part); }
  }
  return all > 0.0 ? std::min(1.0, visible / all) : 0.0;
}

}  // namespace radiosity
