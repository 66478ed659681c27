// SPDX-License-Identifier: MIT
#include <radiosity/audit/picture_error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/surface_error.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<PictureAudit> PictureAudit::make(const Scene& scene) {
  if (!faults(scene).empty()) { return std::nullopt; }
  const LightUnit unit = light_unit(scene);
  const Scene own = in_unit(scene, unit);
  PrepareResult result = prepare(own);
  if (!result.prepared || !result.prepared->plan.traceable) { return std::nullopt; }
  return PictureAudit{own, unit, std::move(*result.prepared)};
}

HALFLIGHT_INLINE std::optional<PictureError> PictureAudit::measure(const ShownPicture& picture, const AuditGoal& goal, unsigned threads,
                                                                   std::uint64_t seed, const Control& control) const {
  std::uint64_t keys = 0;
  Measured measured;
  const auto measure = [&](std::uint64_t points, std::uint32_t paths, Measured& to) {
    to.side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(points))));
    const std::uint64_t first = std::exchange(keys, keys + std::uint64_t{to.side} * to.side);
    to.samples.assign(std::size_t{to.side} * to.side, {});
    constexpr std::size_t batch = 512;  // between two looks at the cancel flag
    for (std::size_t done = 0; done < to.samples.size() && !control.cancelled(); done += batch) {
      parallel_for(
          std::min(batch, to.samples.size() - done), thread_count(threads),
          [&](std::size_t offset) {
            if (control.cancelled()) { return; }
            const std::size_t i = done + offset;
            to.samples[i] = measure_pixel(picture, seed, first + i, i % to.side, i / to.side, to.side, paths);
          },
          4);
      control.report("audit", static_cast<double>(done) / static_cast<double>(to.samples.size()));
    }
    for (const Sample& sample : to.samples) {
      to.rays += sample.rays;
      if (sample.valid) { to.sums.add(sample.square, sample.reference, sample.noise); }
    }
    return !control.cancelled();
  };
  const AuditGoal own = goal.among_rays_of(prepared_->objects.ray_work());
  Measured steering;
  if (own.rays_to_steer > 0 && !measure(steering_points, steering_paths(own), steering)) { return std::nullopt; }
  if (!measure_to_goal<Measured>(
          measure, [](const Measured& m) -> const ErrorSums& { return m.sums; }, own, measured)) {
    return std::nullopt;
  }
  const std::optional<ErrorEstimate> error = measured.sums.estimate();
  if (!error) { return std::nullopt; }
  PictureError result;
  result.error = *error;
  result.points = measured.sums.square.size();
  result.rays = measured.rays;
  result.audited = static_cast<double>(result.points) / static_cast<double>(measured.samples.size());
  const auto [over2, over8] = shares_off(picture, measured);
  result.over2 = over2;
  result.over8 = over8;
  result.worst = worst_tile(picture, measured);
  result.steering = steering.sums.estimate();
  return result;
}

HALFLIGHT_INLINE PictureAudit::PictureAudit(const Scene& scene, const LightUnit& unit, Prepared prepared)
    : unit_{unit}, prepared_{std::make_unique<Prepared>(std::move(prepared))}, tracer_{scene, prepared_->objects, prepared_->surfaces} {
  const auto inputs = surfaces(scene);
  all_emit_ =
      std::none_of(inputs.begin(), inputs.end(), [&](const InputSurface& s) { return is_black(scene.materials[s.material].emission); });
}

HALFLIGHT_INLINE std::optional<PictureAudit::Seen> PictureAudit::seen(const ShownPicture& picture, double x, double y,
                                                                      std::uint64_t& rays) const {
  const raycast::Scene& objects = prepared_->objects;
  raycast::Segment ray = picture.ray(x, y);
  ray.origin = (ray.origin - prepared_->frame.centre) * prepared_->frame.scale;
  ray.direction = glm::normalize(ray.direction) * objects.diameter();
  std::uint32_t from = raycast::no_object;
  std::uint32_t sheet = raycast::unknown_sheet;
  constexpr int most = 10'000;  // only backs are passed, so this ends what rounding might not
  for (int passed = 0; passed < most; ++passed) {
    ++rays;
    const auto hit = objects.closest(ray, from, sheet);
    if (!hit) { return std::nullopt; }
    const raycast::SurfacePoint point = objects.object(hit->object).project(hit->sheet, ray.at(hit->t));
    if (hit->front && !objects.covered(point.position, point.normal, hit->object)) { return Seen{point, hit->object, hit->sheet}; }
    ray.origin = point.position;
    from = hit->object;
    sheet = hit->sheet;
  }
  return std::nullopt;
}

HALFLIGHT_INLINE PictureAudit::Sample PictureAudit::measure_pixel(const ShownPicture& picture, std::uint64_t seed, std::uint64_t key,
                                                                  std::size_t column, std::size_t row, std::uint32_t side,
                                                                  std::uint32_t paths) const {
  Sample sample;
  Random random{seed, key, 0x706978656cull};
  const auto place = [&](std::size_t cell, std::uint32_t pixels) {
    const double at = (static_cast<double>(cell) + random.uniform()) / side * pixels;
    return std::min(static_cast<std::uint32_t>(at), pixels - 1);
  };
  sample.x = place(column, picture.width);
  sample.y = place(row, picture.height);
  bool sees = false;
  Color emitted{0.0};
  for (std::uint32_t k = 0; k < 16; ++k) {
    const auto at = seen(picture, sample.x + (k % 4 + 0.5) / 4.0, sample.y + (k / 4 + 0.5) / 4.0, sample.rays);
    const Color own = at ? emission(*at) : Color{0.0};  // where nothing is, nothing is emitted
    if (k == 0) { emitted = own; }
    if (own != emitted) { return sample; }
    sees = sees || at.has_value();
  }
  if (!sees || (!all_emit_ && !is_black(emitted))) { return sample; }
  bool edge = false;  // of a lamp
  const TwoEstimates light{seed, key, paths, [&](PathNumbers& numbers) -> PathTracer::Light {
                             const double u = numbers.uniform();
                             const auto at = seen(picture, sample.x + u, sample.y + numbers.uniform(), sample.rays);
                             edge = edge || (at ? emission(*at) : Color{0.0}) != emitted;
                             if (!at) { return {}; }
                             return tracer_.radiosity(at->point.position, at->point.normal, at->object, at->sheet, numbers, sample.rays);
                           }};
  if (edge) { return sample; }
  const Color shown = unit_.to_unit(picture.radiosity(sample.x, sample.y));
  const auto level = [&](double b) { return picture.level(unit_.to_watts(Color{b}).x); };
  sample.square = glm::dot(light.all[0] - shown, light.all[1] - shown);
  sample.reference = glm::dot(light.all[0] - emitted, light.all[1] - emitted);
  sample.noise = light.noise();
  for (int c = 0; c < 3; ++c) {
    const double off = level(0.5 * (light.all[0][c] + light.all[1][c])) - level(shown[c]);
    sample.levels = std::max(sample.levels, std::abs(off));
    sample.noise_in_levels = std::max(sample.noise_in_levels, std::abs(level(light.all[0][c]) - level(light.all[1][c])));
    sample.square_in_levels += (level(light.all[0][c]) - level(shown[c])) * (level(light.all[1][c]) - level(shown[c]));
  }
  sample.valid = true;
  return sample;
}

HALFLIGHT_INLINE std::array<ShareBounds, 2> PictureAudit::shares_off(const ShownPicture& picture, const Measured& measured) {
  // Two standard errors of the mean of both estimates are the RMS difference between them, over the pixels of a tile. Three are taken: of a
  // hundred right pixels, two errors would show five to be wrong.
  std::array<double, 16> doubt{}, count{};
  ErrorSums squares;
  for (const Sample& sample : measured.samples) {
    if (!sample.valid) { continue; }
    doubt[tile(picture, sample)] += sample.noise_in_levels * sample.noise_in_levels;
    count[tile(picture, sample)] += 1.0;
    squares.add(sample.square_in_levels, 1.0, 0.0);
  }
  for (std::size_t t = 0; t < 16; ++t) { doubt[t] = count[t] > 0.0 ? 1.5 * std::sqrt(doubt[t] / count[t]) : 0.0; }
  // However noisy a pixel: not more of them can be so far off than their mean square allows (Chebyshev).
  const std::optional<ErrorEstimate> rms = squares.estimate();
  const auto allowed = [&](double levels) { return rms ? rms->high * rms->high / (levels * levels) : 1.0; };
  const auto share = [&](double levels) {
    ShareBounds bounds;
    const double one = 1.0 / static_cast<double>(squares.square.size());
    for (const Sample& sample : measured.samples) {
      if (!sample.valid) { continue; }
      const double by_noise = doubt[tile(picture, sample)];
      bounds.least += sample.levels - by_noise > levels ? one : 0.0;
      bounds.most += sample.levels + by_noise > levels ? one : 0.0;
    }
    bounds.most = std::max(bounds.least, std::min(bounds.most, allowed(levels)));
    return bounds;
  };
  return {share(2.0), share(8.0)};
}

HALFLIGHT_INLINE std::optional<PictureError::Tile> PictureAudit::worst_tile(const ShownPicture& picture, const Measured& measured) {
  double mean_reference = 0.0;
  for (const double r : measured.sums.reference) { mean_reference += r / static_cast<double>(measured.sums.reference.size()); }
  std::array<ErrorSums, 16> tiles;
  for (const Sample& sample : measured.samples) {
    if (sample.valid) { tiles[tile(picture, sample)].add(sample.square, mean_reference, sample.noise); }
  }
  std::optional<PictureError::Tile> worst;
  for (std::uint32_t t = 0; t < tiles.size(); ++t) {
    const std::optional<ErrorEstimate> of_tile = tiles[t].square.size() >= 16 ? tiles[t].estimate() : std::nullopt;
    if (of_tile && (!worst || of_tile->low > worst->error.low)) { worst = PictureError::Tile{t % 4, t / 4, *of_tile}; }
  }
  return worst;
}

}  // namespace radiosity
