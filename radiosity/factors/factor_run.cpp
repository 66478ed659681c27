// SPDX-License-Identifier: MIT
#include <radiosity/factors/factor_run.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/factors/factor_faces.hpp>
#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_meshes.hpp>
#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/factors/factor_rows.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE bool FactorRun::curved_between(const FactorRow& a, const FactorRow& b) const {
  const raycast::Scene& scene = prepared.objects;
  for (std::uint32_t o = 0; o < scene.size(); ++o) {
    const raycast::PlacedObject& object = scene.object(o);
    if (object.exact() || (object.inside() && object.convex())) { continue; }
    if (object.inside()) { return true; }
    for (const Facet& p : a.facets) {
      for (const Facet& q : b.facets) {
        Piece upper_p;
        Piece upper_q;
        Piece lower;
        part(p.contour, {q.contour[0], q.normal}, upper_p, lower);
        part(q.contour, {p.contour[0], p.normal}, upper_q, lower);
        if (upper_p.empty() || upper_q.empty()) { continue; }
        if (!Shaft{upper_p, upper_q, slack}.misses(object.bounds())) { return true; }
      }
    }
  }
  return false;
}

HALFLIGHT_INLINE void FactorRun::by_faces() {
  const std::size_t n = rows.rows.size();
  constexpr std::size_t most_facets = 4096;  // per pair of rows; with more, rays are faster
  constexpr std::size_t most_blockers = 1024;
  exchange.resize(n * n);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i; j < n; ++j) {
      const FactorRow& a = rows.rows[i];
      const FactorRow& b = rows.rows[j];
      if (a.exact && b.exact && a.facets.size() * b.facets.size() <= most_facets) { pairs.emplace_back(i, j); }
    }
  }
  if (blockers.size() > most_blockers) { return; }
  std::vector<std::uint64_t> asked(pairs.size(), 0);
  parallel_for(
      pairs.size(), thread_count(options.threads),
      [&](std::size_t k) {
        const auto [i, j] = pairs[k];
        const FactorRow& a = rows.rows[i];
        const FactorRow& b = rows.rows[j];
        if (curved_between(a, b)) { return; }
        // Errors are relative to the larger one of the two factors. The uncertainties of random points add up over the pairs of
        // facets like independent errors.
        const double unit = std::min(area[i].value, area[j].value) /
                            std::sqrt(static_cast<double>(std::max<std::size_t>(1, a.facets.size() * b.facets.size())));
        IntegralLimits limits{std::min(0.1 * options.error, 1e-6) * unit, options.error * unit, 200'000,
                              scramble(options.seed ^ scramble(i * n + j))};
        Estimate sum;
        double square = 0.0;
        for (const Facet& p : a.facets) {
          for (const Facet& q : b.facets) {
            if (i == j && &p == &q) { continue; }
            const Estimate part = radiosity::exchange({p.contour, p.normal}, {q.contour, q.normal}, blockers, slack, limits, asked[k]);
            ++limits.seed;
            sum.value += part.value;
            square += part.error * part.error;
          }
        }
        sum.error = std::sqrt(square);
        exchange[i * n + j] = sum;
      },
      1);
  for (const std::uint64_t a : asked) { points += a; }
}

HALFLIGHT_INLINE bool FactorRun::stands_free(const FactorRow& row) const {
  const raycast::Scene& scene = prepared.objects;
  const raycast::PlacedObject& object = scene.object(row.object);
  if (!object.convex()) { return false; }
  if (object.exact()) { return row.exact; }
  const raycast::Box box = object.bounds().grown(slack);
  for (std::uint32_t o = 0; o < scene.size(); ++o) {
    if (o == row.object) { continue; }
    const raycast::PlacedObject& other = scene.object(o);
    const bool apart = glm::any(glm::lessThan(box.hi, other.bounds().lo)) || glm::any(glm::lessThan(other.bounds().hi, box.lo));
    if (!other.inside()) {
      // Allowed: the other object stands inside this room, away from its walls.
      const bool within = object.inside() && clear_of_walls(object, other.bounds());
      if (!apart && !within) { return false; }
    } else if (object.inside() || !other.convex() || !clear_of_walls(other, box)) {
      return false;
    }
  }
  return true;
}

HALFLIGHT_INLINE bool FactorRun::clear_of_walls(const raycast::PlacedObject& room, const raycast::Box& box) const {
  for (unsigned c = 0; c < 8; ++c) {
    raycast::Spans spans;
    const raycast::Segment along{box.corner(c), {1.0, 0.0, 0.0}};  // unit direction, so t is a length
    room.spans(along, spans);
    for (const raycast::Span& span : spans) {
      if (span.in.t <= slack && span.out.t >= -slack) { return false; }
    }
  }
  return true;
}

HALFLIGHT_INLINE bool FactorRun::nothing_between(std::uint32_t a, std::uint32_t b) const {
  const raycast::Scene& scene = prepared.objects;
  raycast::Box hull = scene.object(a).bounds();
  hull.extend(scene.object(b).bounds());
  for (std::uint32_t o = 0; o < scene.size(); ++o) {
    if (o == a || o == b || (scene.object(o).inside() && scene.object(o).convex())) { continue; }
    if (scene.object(o).inside() || scene.object(o).bounds().meets(hull)) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE void FactorRun::by_meshes() {
  const std::size_t n = rows.rows.size();
  std::vector<RowMeshes> meshes(n);
  std::vector<bool> free(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const FactorRow& row = rows.rows[i];
    free[i] = stands_free(row);
    if (!free[i]) { continue; }
    if (row.exact) {
      for (const Facet& facet : row.facets) { meshes[i].level[2].push_back(make_patch({facet.contour.begin(), facet.contour.end()})); }
      continue;
    }
    if (meshes[i].level[2].empty()) { make_meshes(prepared.objects.object(row.object), rows.row_of[row.object], meshes); }
    area[i] = meshes[i].area;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i; j < n; ++j) {
      const std::uint32_t a = rows.rows[i].object;
      const std::uint32_t b = rows.rows[j].object;
      if (exchange[i * n + j] || !free[i] || !free[j]) { continue; }
      const raycast::PlacedObject& object = prepared.objects.object(a);
      if (a == b && !object.inside()) {
        exchange[i * n + j] = Estimate{};  // a convex object does not see itself
      } else if (nothing_between(a, b)) {
        pairs.emplace_back(i, j);
      }
    }
  }
  parallel_for(
      pairs.size(), thread_count(options.threads),
      [&](std::size_t k) {
        const auto [i, j] = pairs[k];
        exchange[i * n + j] = free_exchange(meshes[i], meshes[j], rows.rows[i].object == rows.rows[j].object);
      },
      1);
}

HALFLIGHT_INLINE bool FactorRun::needs_rays(std::size_t i) const {
  for (std::size_t j = 0; j < rows.rows.size(); ++j) {
    if (!known(i, j)) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE std::vector<std::shared_ptr<RayCounter>> FactorRun::by_rays() {
  const raycast::Scene& scene = prepared.objects;
  const auto n = static_cast<std::uint32_t>(rows.rows.size());
  std::vector<std::shared_ptr<RayCounter>> counters(n);
  for (std::uint32_t i = 0; i < n;) {
    const FactorRow& row = rows.rows[i];
    std::uint32_t end = i + 1;
    if (row.facets.empty()) {
      while (end < n && rows.rows[end].object == row.object) { ++end; }
    }
    bool needed = false;
    for (std::uint32_t k = i; k < end; ++k) { needed = needed || needs_rays(k); }
    if (needed && !(row.exact && row.facets.empty())) {  // exact without facets: completely buried
      RaySource source{row.object, !row.exact && may_be_covered(row.object), row.facets, i, end - i, rows.row_of[row.object]};
      auto counter = std::make_shared<RayCounter>(scene, rows.row_of, source, n, options.seed);
      run(*counter, i, end);
      for (std::uint32_t k = i; k < end; ++k) {
        counters[k] = counter;
        if (!(area[k].error > 0.0) && !row.exact) { area[k] = {counter->area(k).value, counter->area(k).error}; }
      }
    }
    i = end;
  }
  return counters;
}

HALFLIGHT_INLINE void FactorRun::run(RayCounter& counter, std::uint32_t first, std::uint32_t end) const {
  const std::uint64_t most = std::max<std::uint64_t>(options.rays / sequences, 64);
  for (std::uint64_t lines = std::min<std::uint64_t>(1024, most);; lines = std::min(2 * lines, most)) {
    counter.extend(lines, thread_count(options.threads));
    bool enough = true;
    for (std::uint32_t i = first; i < end; ++i) {
      if (counter.rays(i) == 0) { continue; }  // the row is buried
      // If the area comes from the rays, too, its error adds to that of the factors.
      const RayCounter::Mean by_rays = counter.area(i);
      const double relative = rows.rows[i].exact || area[i].error > 0.0 ? 0.0 : by_rays.error / by_rays.value;
      for (std::uint32_t j = 0; j < rows.rows.size(); ++j) {
        const RayCounter::Mean f = counter.factor(i, j);
        enough = enough && (known(i, j) || std::hypot(f.error, f.value * relative) <= 0.9 * options.error);
      }
    }
    if (enough || lines >= most) { return; }
  }
}

HALFLIGHT_INLINE bool FactorRun::may_be_covered(std::uint32_t object) const {
  const raycast::Scene& scene = prepared.objects;
  const raycast::Box box = scene.object(object).bounds().grown(slack);
  for (std::uint32_t o = 0; o < scene.size(); ++o) {
    if (o == object) { continue; }
    // Even an object well inside the bounds of a convex room may be outside the room near its corners.
    if (scene.object(o).inside() || scene.object(o).bounds().meets(box)) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE Estimate weighted(const std::vector<std::shared_ptr<RayCounter>>& counters, const std::vector<Estimate>& area,
                                   std::uint32_t i, std::uint32_t j) {
  Estimate result;
  double weights = 0.0;
  double square = 0.0;
  for (int end = 0; end < (i == j ? 1 : 2); ++end) {
    const std::uint32_t from = end == 0 ? i : j;
    const std::uint32_t to = end == 0 ? j : i;
    if (counters[from] == nullptr || !(area[from].value > 0.0)) { continue; }
    const RayCounter::Mean f = counters[from]->factor(from, to);
    const double rays = static_cast<double>(counters[from]->rays(from));
    const double spread = std::hypot(f.error * area[from].value, f.value * area[from].error);
    // The variance estimated from sixteen numbers is itself uncertain. So a sixteenth of the variance of random sampling is added,
    // because low-discrepancy points hardly ever reduce the error by more than four times.
    const double random = area[from].value * std::sqrt(f.value * std::max(0.0, 1.0 - f.value) + 1.0 / rays) / std::sqrt(rays);
    const double weight = 1.0 / (spread * spread + random * random / 16.0);
    result.value += weight * f.value * area[from].value;
    square += weight * weight * spread * spread;
    weights += weight;
  }
  if (!(weights > 0.0)) { return {}; }
  return {result.value / weights, std::sqrt(square) / weights};
}

}  // namespace detail

}  // namespace radiosity
