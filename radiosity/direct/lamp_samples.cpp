// SPDX-License-Identifier: MIT
#include <radiosity/direct/lamp_samples.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/geometry/hilbert_curve.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<LampSample> lamp_samples(const Facets& facets, std::span<const SampleEnd> ends, std::size_t count,
                                                      std::uint64_t seed) {
  struct Triangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0}, normal{0.0};
    SampleEnd end;
    std::uint64_t place = 0;
  };
  raycast::Box bounds;
  for (const Facets::Facet& facet : facets.facets) {
    for (const glm::dvec3& p : facet.contour) { bounds.extend(p); }
  }
  const glm::dvec3 size = bounds.size();
  const double width = std::max({size.x, size.y, size.z});
  std::vector<Triangle> triangles;
  std::vector<double> until;  // cumulative area
  double total = 0.0;
  for (std::size_t f = 0; f < facets.facets.size(); ++f) {
    const Facets::Facet& facet = facets.facets[f];
    for (std::size_t i = 1; i + 1 < facet.contour.size(); ++i) {
      Triangle t{facet.contour[0], facet.contour[i], facet.contour[i + 1], facet.normal, ends[f]};
      t.place = along_hilbert_curve(((t.a + t.b + t.c) / 3.0 - bounds.lo) / width);
      triangles.push_back(t);
    }
  }
  std::stable_sort(triangles.begin(), triangles.end(), [](const Triangle& a, const Triangle& b) { return a.place < b.place; });
  for (const Triangle& t : triangles) {
    total += triangle_area(t.a, t.b, t.c);
    until.push_back(total);
  }
  const Sobol4 sequence{seed, 0x6c616d70ull};
  std::vector<LampSample> samples;
  samples.reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::array<double, 4> u = sequence(k);
    const double at = u[0] * total;
    const std::size_t i = drawn_index(until, at);
    const double before = i > 0 ? until[i - 1] : 0.0;
    const double root = std::sqrt(std::clamp((at - before) / (until[i] - before), 0.0, 1.0));
    const Triangle& t = triangles[i];
    const glm::dvec3 on_facet = t.a + root * (1.0 - u[1]) * (t.b - t.a) + root * u[1] * (t.c - t.a);
    samples.push_back({on_facet + t.end.lift * t.normal, t.normal, t.end});
  }
  return samples;
}

HALFLIGHT_INLINE std::vector<LampSample> disk_samples(const SampleEnd& end, std::size_t count, std::uint64_t seed) {
  const Sobol4 sequence{seed, 0x6469736bull};
  std::vector<LampSample> samples;
  samples.reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::array<double, 4> u = sequence(k);
    const double a = 2.0 * u[0] - 1.0, b = 2.0 * u[1] - 1.0;
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b, share = radius != 0.0 ? (wide ? b : a) / radius : 0.0;
    const double angle = 0.25 * std::numbers::pi * (wide ? share : 2.0 - share);
    samples.push_back({{radius * std::cos(angle), radius * std::sin(angle), 0.0}, {}, end});
  }
  return samples;
}

HALFLIGHT_INLINE std::vector<LampSample> rim_samples(const SampleEnd& end) {
  constexpr int count = 16;
  constexpr double radius = 0.99;
  std::vector<LampSample> samples;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    samples.push_back({{radius * std::cos(angle), radius * std::sin(angle), 0.0}, {}, end});
  }
  return samples;
}

HALFLIGHT_INLINE SeenBall::SeenBall(const glm::dvec3& centre, double radius, const glm::dvec3& x)
    : centre_{centre}, x_{x}, radius_{radius}, distance_{glm::length(centre - x)} {
  if (!(distance_ > radius)) { return; }
  axis_ = (centre - x) / distance_;
  const auto [s, t] = orthonormal(axis_);
  s_ = s;
  t_ = t;
  const double sine = radius / distance_;
  versine_ = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
}

HALFLIGHT_INLINE LampSample SeenBall::at(const LampSample& of_disk) const {
  const glm::dvec3& p = of_disk.position;
  const double versine = versine_ * (p.x * p.x + p.y * p.y), cosine = 1.0 - versine;
  const double sine = std::sqrt(versine_ * (1.0 + cosine));  // over the radius in the disk
  const glm::dvec3 direction = cosine * axis_ + sine * (p.x * s_ + p.y * t_);
  const double aside = distance_ * sine * std::sqrt(p.x * p.x + p.y * p.y);
  const double way = distance_ * cosine - std::sqrt(std::max(0.0, radius_ * radius_ - aside * aside));
  const glm::dvec3 position = x_ + way * direction;
  return {position, (position - centre_) / radius_, of_disk.end};
}

HALFLIGHT_INLINE FineSamples::FineSamples(std::span<const LampSample> coarse, std::span<const LampSample> fine)
    : begin_(coarse.size() + 1, 0), beside_(coarse.size()) {
  std::vector<std::uint32_t> cell(fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    std::array<std::uint32_t, 2> nearest{0, 0};
    std::array<double, 2> distance{raycast::infinity, raycast::infinity};
    for (std::uint32_t c = 0; c < coarse.size(); ++c) {
      const glm::dvec3 d = fine[i].position - coarse[c].position;
      const double square = glm::dot(d, d);
      if (!(square < distance[1])) { continue; }
      const std::size_t place = square < distance[0] ? 0 : 1;
      if (place == 0) {
        nearest[1] = nearest[0];
        distance[1] = distance[0];
      }
      nearest[place] = c;
      distance[place] = square;
    }
    cell[i] = nearest[0];
    ++begin_[nearest[0] + 1];
    beside_[nearest[0]].push_back(nearest[1]);
    beside_[nearest[1]].push_back(nearest[0]);
  }
  for (std::vector<std::uint32_t>& cells : beside_) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }
  for (std::size_t c = 0; c < coarse.size(); ++c) { begin_[c + 1] += begin_[c]; }
  std::vector<std::size_t> next{begin_.begin(), begin_.end() - 1};
  samples_.resize(fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i) { samples_[next[cell[i]]++] = fine[i]; }
}

}  // namespace radiosity
