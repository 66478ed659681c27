// SPDX-License-Identifier: MIT
#include <brep/inline.hpp>

#include <radiosity/direct/lit_region.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/geometry/form_factor.hpp>

// LitRegion: the visible share of a lamp, by segments to its samples.

namespace radiosity {

namespace detail {

inline constexpr std::size_t least_carrying = 4;  // least number of samples facing the point from which the visible share is estimated

}  // namespace detail

HALFLIGHT_INLINE const glm::dvec3& LitRegion::lifted(const glm::dvec3& x, const glm::dvec3& n) {
  if (!(lift_ > 0.0)) { return last_lifted_ = x; }
  if (x != last_ || n != last_normal_) {
    last_ = x;
    last_normal_ = n;
    last_lifted_ = light_->lifted(owner_, x, n);
  }
  return last_lifted_;
}

HALFLIGHT_INLINE LitRegion::Asked16 LitRegion::ask16(Reach& reach, const glm::dvec3& x, const glm::dvec3& n,
                                                     std::span<const LampSample> samples) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  if (!lamp.ball) { return ask_placed16(reach, x, n, samples); }
  const SeenBall ball{lamp.facets.parts[0].centre, lamp.facets.parts[0].radius, x};
  if (!ball.outside()) { return {}; }
  std::array<LampSample, 16> placed;
  for (std::size_t k = 0; k < samples.size(); ++k) { placed[k] = ball.at(samples[k]); }
  Asked16 result = ask_placed16(reach, x, n, std::span{placed}.first(samples.size()));
  // Equal solid angles instead of equal areas.
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (result.weight[k] > 0.0) { result.weight[k] = glm::dot(n, glm::normalize(placed[k].position - x)); }
  }
  return result;
}

HALFLIGHT_INLINE LitRegion::Asked16 LitRegion::ask_placed16(Reach& reach, const glm::dvec3& x, const glm::dvec3& n,
                                                            std::span<const LampSample> samples) {
  const double off_surface = light_->off_surface();
  const glm::dvec3 from = lift_ > 0.0 ? lifted(x, n) : x + off_surface * n;
  // Convex as well, because otherwise meshes would stand in for it.
  const bool curved = owner_ != raycast::no_object && !light_->objects_->object(owner_).flat();
  const std::uint32_t source = curved ? owner_ : raycast::no_object;
  Asked16 result;
  raycast::Segments16 segments;
  for (unsigned k = 0; k < samples.size(); ++k) {
    const LampSample& sample = samples[k];
    const glm::dvec3 d = sample.position - x;
    const double cosines = glm::dot(n, d) * -glm::dot(sample.normal, d);
    if (!(glm::dot(n, d) > 0.0) || !(cosines > 0.0)) { continue; }
    const double r2 = glm::dot(d, d);
    result.weight[k] = cosines / (r2 * r2);
    const double to_lift = sample.end.owner == raycast::no_object ? off_surface : 0.0;
    segments.set(k, {from, sample.position + to_lift * sample.normal - from}, source, sample.end.owner);
  }
  rays_ += static_cast<unsigned>(std::popcount(segments.lanes));
  result.seen = segments.lanes;
  if (segments.lanes != 0) { result.seen &= ~light_->objects_->occluded16(segments, reach.list, reach.hint); }
  return result;
}

HALFLIGHT_INLINE const LitRegion::Survey& LitRegion::survey(Reach& reach) {
  if (reach.survey) { return *reach.survey; }
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  Survey& result = reach.survey.emplace(Survey{.dark = true, .mixed = {}});
  if (!region_.planar() || lamp.fine.empty()) { return result; }
  constexpr std::size_t of_cell = 4;
  for (std::uint32_t cell = 0; cell < lamp.samples.size(); ++cell) {
    const std::span<const LampSample> samples = lamp.fine.of(cell);
    const Asked16 asked = ask16(reach, region_.centre, region_.normal, samples.first(std::min(of_cell, samples.size())));
    result.dark = result.dark && asked.seen == 0;
    const auto carrying = std::count_if(asked.weight.begin(), asked.weight.end(), [](double w) { return w > 0.0; });
    if (asked.seen != 0 && std::popcount(asked.seen) < carrying) { result.mixed.push_back(cell); }
  }
  return result;
}

HALFLIGHT_INLINE bool LitRegion::mostly_open(Reach& reach, const glm::dvec3& x, const glm::dvec3& n) {
  const std::span<const LampSample> samples = light_->lamps_[reach.lamp].samples;
  const Asked16 found = ask16(reach, x, n, samples.first(std::min<std::size_t>(16, samples.size())));
  double all = 0.0, seen = 0.0;
  for (unsigned k = 0; k < 16; ++k) {
    all += found.weight[k];
    seen += (found.seen >> k & 1u) != 0 ? found.weight[k] : 0.0;
  }
  return seen > 0.5 * all;
}

// n segments give the visible share with an error of some n^-3/4. The number is chosen so that a lamp that gives only a part of the light
// adds no more error to the whole than a lamp that gives all of it. A rough estimate of its light suffices: a flat lamp shows its area
// times the cosine, any other one a quarter of its area, as convex bodies do on average (Cauchy 1832).
HALFLIGHT_INLINE std::size_t LitRegion::segments_for(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n,
                                                     const Color& others) {
  const std::size_t all = lamp.samples.size();
  const glm::dvec3 d = lamp.centre - x;
  const double r2 = glm::dot(d, d), r = std::sqrt(r2);
  if (is_black(others) || r < 2.0 * lamp.radius) { return all; }
  const double falls = std::min(1.0, (glm::dot(n, d) + lamp.radius) / r);
  const double shown = lamp.flat ? std::abs(glm::dot(lamp.facets.facets[0].normal, d)) / r : 0.25;
  const Color own = lamp.exitance * (std::max(0.0, falls) * shown * lamp.area / (std::numbers::pi * r2));
  double part = 0.0;
  for (int c = 0; c < 3; ++c) { part = std::max(part, own[c] > 0.0 ? own[c] / (own[c] + others[c]) : 0.0); }
  const std::size_t wanted = std::bit_ceil(static_cast<std::size_t>(std::ceil(part * static_cast<double>(all))));
  return std::clamp(wanted, std::min(detail::fewest_segments, all), all);
}

// Uses `most` of the samples, a multiple of sixteen, or more until enough of them face the point.
HALFLIGHT_INLINE double LitRegion::seen_share(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::size_t most) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  weight_.clear();
  seen_.clear();
  double all = 0.0;
  double seen = 0.0;
  std::size_t carrying = 0;
  std::size_t quarter = most / 4;  // after so many it is decided whether the point sees all of the lamp or nothing
  bool rim_seen = true, rim_hidden = true;
  if (!lamp.rim.empty() && most > 16) {
    const Asked16 rim = ask16(reach, x, n, lamp.rim);
    rim_hidden = rim.seen == 0;
    for (unsigned k = 0; k < 16; ++k) { rim_seen = rim_seen && (rim.weight[k] == 0.0 || (rim.seen >> k & 1u) != 0); }
    quarter = 16;
  }
  for (std::size_t first = 0; first < lamp.samples.size() && (first < most || carrying < detail::least_carrying); first += 16) {
    const Asked16 found = ask16(reach, x, n, std::span{lamp.samples}.subspan(first, 16));
    for (unsigned k = 0; k < 16; ++k) {
      weight_.push_back(found.weight[k]);
      seen_.push_back(static_cast<char>(found.seen >> k & 1u));
      all += found.weight[k];
      carrying += found.weight[k] > 0.0 ? 1 : 0;
      if (seen_.back() != 0) { seen += found.weight[k]; }
    }
    const std::size_t asked = first + 16;
    if (asked == std::max<std::size_t>(16, quarter) && too_near(lamp, x, n, all / static_cast<double>(asked))) {
      return seen_share_of_parts(reach, x, n);
    }
    if (asked != quarter || carrying < detail::least_carrying) { continue; }
    if ((seen == all && rim_seen) || (seen == 0.0 && rim_hidden && survey(reach).dark)) { return seen > 0.0 ? 1.0 : 0.0; }
  }
  if (carrying < detail::least_carrying) { return seen_share_of_parts(reach, x, n); }
  if (!lamp.fine.empty() && most == lamp.samples.size() && seen < all) { refine(reach, x, n, all, seen); }
  return all > 0.0 ? seen / all : 0.0;
}

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 middle_of(const Polygon& contour) {
  glm::dvec3 sum{0.0};
  for (const glm::dvec3& p : contour) { sum += p / static_cast<double>(contour.size()); }
  return sum;
}

// The part on that side of a plane through its middle to which `normal` points.
[[nodiscard]] HALFLIGHT_INLINE LampPart half_of(const LampPart& whole, const glm::dvec3& normal, const glm::dvec3& x, const glm::dvec3& n) {
  LampPart half{{}, whole.facet, 0.0};
  clip_to_horizon(whole.contour, middle_of(whole.contour), normal, half.contour);
  if (half.contour.size() > 2) { half.factor = point_to_polygon(x, n, half.contour); }
  return half;
}

// Bisects parts across their longest edges until none has more than a 48th of the total form factor.
HALFLIGHT_INLINE void cut_evenly(std::vector<LampPart>& parts, const glm::dvec3& x, const glm::dvec3& n) {
  constexpr std::size_t most_cuts = 256;
  constexpr double share = 1.0 / 48.0;
  double all = 0.0;
  for (const LampPart& part : parts) { all += part.factor; }
  for (std::size_t k = 0, cuts = 0; k < parts.size();) {
    if (!(parts[k].factor > share * all) || cuts == most_cuts) {
      ++k;
      continue;
    }
    const LampPart whole = std::move(parts[k]);
    glm::dvec3 longest{0.0};
    for (std::size_t i = 0; i < whole.contour.size(); ++i) {
      const glm::dvec3 edge = whole.contour[i + 1 < whole.contour.size() ? i + 1 : 0] - whole.contour[i];
      if (glm::dot(edge, edge) > glm::dot(longest, longest)) { longest = edge; }
    }
    parts[k] = half_of(whole, longest, x, n);
    parts.push_back(half_of(whole, -longest, x, n));
    ++cuts;
  }
}

}  // namespace detail

HALFLIGHT_INLINE bool LitRegion::too_near(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n, double mean_weight) {
  if (lamp.ball) { return false; }  // its samples are those that are seen
  const bool near = std::any_of(lamp.facets.parts.begin(), lamp.facets.parts.end(), [&](const Facets::Part& part) {
    const glm::dvec3 d = part.centre - x;
    return glm::dot(d, d) <= 4.0 * part.radius * part.radius;
  });
  if (!near) { return false; }
  const double area = lamp.area / lamp.correction;  // of the facets
  const double by_outline = radiosity::form_factor(lamp.facets, x, n, light_->slack_, facing_);
  constexpr double off = 0.25, least = 0.02;  // off: relative difference; least: smaller form factors are not worth the effort
  return by_outline > least && std::abs(area * mean_weight / std::numbers::pi - by_outline) > off * by_outline;
}

HALFLIGHT_INLINE double LitRegion::seen_share_of_parts(Reach& reach, const glm::dvec3& x, const glm::dvec3& n) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  if (glm::dot(n, lamp.centre - x) <= -lamp.radius) { return 0.0; }
  std::vector<detail::LampPart> parts;
  for (std::uint32_t f = 0; f < lamp.facets.facets.size(); ++f) {
    if (!(lamp.facets.facets[f].height(x) > light_->slack_)) { continue; }
    detail::LampPart part{{}, f, 0.0};
    clip_to_horizon(lamp.facets.facets[f].contour, x, n, part.contour);
    if (part.contour.size() < 3) { continue; }
    part.factor = point_to_polygon(x, n, part.contour);
    parts.push_back(std::move(part));
  }
  return seen_share_of(reach, x, n, parts);
}

HALFLIGHT_INLINE double LitRegion::seen_share_of(Reach& reach, const glm::dvec3& x, const glm::dvec3& n,
                                                 std::vector<detail::LampPart>& parts) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  detail::cut_evenly(parts, x, n);
  std::erase_if(parts, [](const detail::LampPart& part) { return part.contour.size() < 3; });
  std::vector<LampSample> samples;
  for (const detail::LampPart& part : parts) {
    const glm::dvec3 middle = detail::middle_of(part.contour);
    const glm::dvec3& normal = lamp.facets.facets[part.facet].normal;
    const SampleEnd& end = lamp.ends[part.facet];
    samples.push_back({middle + end.lift * normal, normal, end});
  }
  double all = 0.0, seen = 0.0;
  for (std::size_t first = 0; first < samples.size(); first += 16) {
    const std::size_t count = std::min<std::size_t>(16, samples.size() - first);
    const Asked16 asked = ask_placed16(reach, x, n, std::span{samples}.subspan(first, count));
    for (std::size_t k = 0; k < count; ++k) {
      if (!(asked.weight[k] > 0.0)) { continue; }
      all += parts[first + k].factor;
      if ((asked.seen >> k & 1u) != 0) { seen += parts[first + k].factor; }
    }
  }
  return all > 0.0 ? seen / all : 0.0;
}

HALFLIGHT_INLINE void LitRegion::refine(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, double& all, double& seen) {
  const FineSamples& fine = light_->lamps_[reach.lamp].fine;
  const auto cells = static_cast<std::uint32_t>(seen_.size());
  mixed_.clear();
  double seen_cells = 0.0;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    seen_cells += seen_[cell];
    const auto beside = fine.beside(cell);
    if (std::any_of(beside.begin(), beside.end(), [&](std::uint32_t other) { return seen_[other] != seen_[cell]; })) {
      mixed_.push_back(cell);
    }
  }
  const std::vector<std::uint32_t>& surveyed = survey(reach).mixed;
  mixed_.insert(mixed_.end(), surveyed.begin(), surveyed.end());
  std::sort(mixed_.begin(), mixed_.end());
  mixed_.erase(std::unique(mixed_.begin(), mixed_.end()), mixed_.end());
  // With m points in each of k partly visible cells, the standard error of the visible area is some sqrt(k / (12 m)) cells.
  constexpr double error = 0.03;
  constexpr std::size_t most = 512;
  const double at_least = std::max(1.0, seen_cells);
  const double wanted = static_cast<double>(mixed_.size()) / (12.0 * error * error * at_least * at_least);
  if (wanted < 1.0 || mixed_.size() > most) { return; }
  const std::size_t of_cell = std::min(static_cast<std::size_t>(std::ceil(wanted)), most / mixed_.size());
  all = seen = 0.0;
  auto next = mixed_.begin();
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (next == mixed_.end() || cell != *next) {
      all += fine.share(cell) * weight_[cell];
      seen += seen_[cell] != 0 ? fine.share(cell) * weight_[cell] : 0.0;
      continue;
    }
    ++next;
    const std::span<const LampSample> samples = fine.of(cell).first(std::min(of_cell, fine.of(cell).size()));
    const double share = fine.share(cell) / static_cast<double>(samples.size());
    for (std::size_t first = 0; first < samples.size(); first += 16) {
      const Asked16 asked = ask16(reach, x, n, samples.subspan(first, std::min<std::size_t>(16, samples.size() - first)));
      for (unsigned k = 0; k < 16; ++k) {
        all += share * asked.weight[k];
        if ((asked.seen >> k & 1u) != 0) { seen += share * asked.weight[k]; }
      }
    }
  }
}

}  // namespace radiosity
