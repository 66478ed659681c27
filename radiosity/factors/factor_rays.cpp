// SPDX-License-Identifier: MIT
#include <radiosity/factors/factor_rays.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/support/draw.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

HALFLIGHT_INLINE RayCounter::RayCounter(const raycast::Scene& scene, const std::vector<std::vector<std::uint32_t>>& row_of,
                                        const RaySource& source, std::uint32_t rows, std::uint64_t seed)
    : scene_{&scene}, row_of_{&row_of}, source_{source}, rows_{rows}, seed_{seed} {
  counts_.begun.assign(sequences * source.rows, 0);
  counts_.hits.assign(sequences * source.rows * rows, 0);
  double area = 0.0;
  for (const Facet& facet : source.facets) { cumulative_.push_back(area += facet.area); }
  const raycast::Box& box = scene.object(source.object).bounds();
  const glm::dvec3 size = box.size();
  box_area_ = 2.0 * box.half_area();
  for (int k = 0; k < 3; ++k) { side_[static_cast<std::size_t>(k)] = size[(k + 1) % 3] * size[(k + 2) % 3] / (0.5 * box_area_); }
}

HALFLIGHT_INLINE void RayCounter::extend(std::uint64_t lines, unsigned threads) {
  const std::uint64_t first = counts_.lines;
  const std::uint64_t total = (lines - first) * sequences;
  const auto workers = static_cast<std::size_t>(std::clamp<std::uint64_t>(total / 4096, 1, threads));
  std::vector<RayCounts> parts(workers);
  const auto work = [&](std::size_t w) {
    RayCounts& own = parts[w];
    own.begun.assign(counts_.begun.size(), 0);
    own.hits.assign(counts_.hits.size(), 0);
    for (std::size_t s = 0; s < sequences; ++s) {
      const Sobol4 sequence{seed_, s + sequences * source_.first_row};
      for (std::uint64_t i = first + w; i < lines; i += workers) { cast(s, sequence(static_cast<std::uint32_t>(i)), own); }
    }
  };
  parallel_for(workers, threads, work, 1);
  for (const RayCounts& part : parts) {  // integers, so the order of addition does not matter
    for (std::size_t i = 0; i < part.begun.size(); ++i) { counts_.begun[i] += part.begun[i]; }
    for (std::size_t i = 0; i < part.hits.size(); ++i) { counts_.hits[i] += part.hits[i]; }
  }
  counts_.lines = lines;
}

HALFLIGHT_INLINE RayCounter::Mean RayCounter::factor(std::uint32_t from, std::uint32_t to) const {
  const auto all = static_cast<double>(rays(from));
  double arrived = 0.0;
  for (std::size_t s = 0; s < sequences; ++s) { arrived += static_cast<double>(hits(s, from, to)); }
  const double few = std::min(arrived, all - arrived);
  const double least = all > 0.0 ? (few > 0.0 ? 1.0 + std::sqrt(std::min(few, 16.0)) : 1.5) / all : 0.0;
  return mean(
      from, [&](std::size_t s) { return static_cast<double>(hits(s, from, to)); }, least);
}

HALFLIGHT_INLINE RayCounter::Mean RayCounter::sum(std::uint32_t from) const {
  const auto all = [&](std::size_t s) {
    double total = 0.0;
    for (std::uint32_t to = 0; to < rows_; ++to) { total += static_cast<double>(hits(s, from, to)); }
    return total;
  };
  return mean(from, all, 0.0);
}

HALFLIGHT_INLINE std::uint64_t RayCounter::rays(std::uint32_t from) const {
  std::uint64_t sum = 0;
  for (std::size_t s = 0; s < sequences; ++s) { sum += begun(s, from); }
  return sum;
}

HALFLIGHT_INLINE RayCounter::Mean RayCounter::area(std::uint32_t from) const {
  std::array<double, sequences> values{};
  for (std::size_t s = 0; s < sequences; ++s) {
    const double share = static_cast<double>(begun(s, from)) / static_cast<double>(counts_.lines);
    values[s] = share * (source_.facets.empty() ? 0.5 * box_area_ : cumulative_.back());
  }
  return mean_of(values);
}

HALFLIGHT_INLINE RayCounter::Mean RayCounter::mean_of(const std::array<double, sequences>& values) {
  constexpr auto n = static_cast<double>(sequences);
  double sum = 0.0;
  double square = 0.0;
  for (const double v : values) { sum += v / n; }
  for (const double v : values) { square += (v - sum) * (v - sum); }
  // Half of the 95 % interval of Student's distribution with 15 degrees of freedom.
  return {sum, 0.5 * 2.1314 * std::sqrt(square / (n * (n - 1.0)))};
}

HALFLIGHT_INLINE void RayCounter::cast(std::size_t s, const std::array<double, 4>& u, RayCounts& counts) const {
  if (!source_.facets.empty()) {
    const double at = u[0] * cumulative_.back();
    const std::size_t index = drawn_index(cumulative_, at);
    const Facet& facet = source_.facets[index];
    const double rest = at - (index > 0 ? cumulative_[index - 1] : 0.0);
    const glm::dvec3 x = point_of(facet, rest, u[1]);
    begin(s, source_.first_row, x, cosine_direction(facet.normal, u[2], u[3]), facet.normal, counts);
    return;
  }
  const raycast::PlacedObject& object = scene_->object(source_.object);
  const raycast::Segment line = line_of(u);
  raycast::Spans spans;
  object.spans(line, spans);
  for (const raycast::Span& span : spans) {
    const bool surface = span.in.t == span.out.t;
    for (const raycast::Crossing* crossing : {&span.in, &span.out}) {
      if (!std::isfinite(crossing->t)) { continue; }
      const glm::dvec3 x = line.at(crossing->t);
      glm::dvec3 direction = crossing == &span.in ? -line.direction : line.direction;
      glm::dvec3 normal{0.0};
      if (surface || source_.may_be_covered) {
        normal = object.project(crossing->sheet, x).normal;
        if (surface && glm::dot(normal, direction) < 0.0) { direction = -direction; }
      }
      begin(s, source_.row_of_sheet[crossing->sheet], x, direction, normal, counts);
      if (surface) { break; }
    }
  }
}

HALFLIGHT_INLINE glm::dvec3 RayCounter::point_of(const Facet& facet, double rest, double v) {
  const Piece& q = facet.contour;
  for (std::size_t i = 1;; ++i) {
    const double area = 0.5 * glm::dot(glm::cross(q[i] - q[0], q[i + 1] - q[0]), facet.normal);
    if (rest < area || i + 2 == q.size()) {
      const double root = std::sqrt(std::clamp(area > 0.0 ? rest / area : 0.0, 0.0, 1.0));
      return q[0] + root * (1.0 - v) * (q[i] - q[0]) + root * v * (q[i + 1] - q[0]);
    }
    rest -= area;
  }
}

HALFLIGHT_INLINE raycast::Segment RayCounter::line_of(const std::array<double, 4>& u) const {
  const raycast::Box& box = scene_->object(source_.object).bounds();
  double rest = u[0];
  int axis = 0;
  while (axis < 2 && rest >= side_[static_cast<std::size_t>(axis)]) { rest -= side_[static_cast<std::size_t>(axis++)]; }
  const double share = side_[static_cast<std::size_t>(axis)];
  double a = std::clamp(share > 0.0 ? rest / share : 0.0, 0.0, 1.0);
  // Opposite sides need not be distinguished: lines have no orientation, and a line that enters through one side leaves through another.
  // So half of each side with all directions is equivalent to all sides with directions inwards.
  const glm::dvec3 size = box.size();
  glm::dvec3 x = box.lo;
  glm::dvec3 n{0.0};
  const bool far = a >= 0.5;
  a = far ? 2.0 * a - 1.0 : 2.0 * a;
  x[(axis + 1) % 3] += a * size[(axis + 1) % 3];
  x[(axis + 2) % 3] += u[1] * size[(axis + 2) % 3];
  if (far) { x[axis] = box.hi[axis]; }
  n[axis] = far ? -1.0 : 1.0;
  return {x, cosine_direction(n, u[2], u[3]) * scene_->diameter()};
}

HALFLIGHT_INLINE void RayCounter::begin(std::size_t s, std::uint32_t row, const glm::dvec3& x, const glm::dvec3& direction,
                                        const glm::dvec3& normal, RayCounts& counts) const {
  if (source_.may_be_covered && scene_->covered(x, normal, source_.object)) { return; }
  const std::size_t own = s * source_.rows + row - source_.first_row;
  ++counts.begun[own];
  const double reach = glm::length(direction);
  const auto hit = scene_->closest({x, direction * (scene_->diameter() / reach)}, source_.object);
  if (hit && hit->front) { ++counts.hits[own * rows_ + (*row_of_)[hit->object][hit->sheet]]; }
}

}  // namespace radiosity
