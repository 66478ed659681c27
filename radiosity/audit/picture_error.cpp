// SPDX-License-Identifier: MIT
#include <radiosity/audit/picture_error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/finite.hpp>
#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/audit/aimed_paths.hpp>
#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_estimates.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/pixel_draw.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
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

HALFLIGHT_INLINE std::optional<PictureError> PictureAudit::measure(const ShownPicture& shown, const AuditGoal& goal, unsigned threads,
                                                                   std::uint64_t seed, const Control& control, std::string* reason) const {
  const ShownPicture picture = from_off_surfaces(shown, prepared_->objects, prepared_->frame);
  std::uint64_t keys = 0, rays = 0;  // rays: including all pilots
  Measured measured;
  bool reflects = false;  // has a pixel been found that counts?
  const double price = ray_work();
  const PixelDraw draw = draw_of(picture, goal.among_rays_of(price).rays / 8, rays, control);
  // A ray at the visible points may cost more or less than the mean over the scene, so it is priced again there.
  const bool may_aim = goal.among_rays_of(price).rays >= least_rays_to_aim;
  const std::optional<PathTracer> aimed = may_aim ? tracer_.aimed(prepared_->surfaces) : std::nullopt;
  const bool pays = aimed && aiming_pays({picture, draw, tracer_, seed}, *aimed, threads, rays);
  const Series series{picture, draw, pays ? *aimed : tracer_, seed};
  const double seen_price = ray_price(series);
  const double own_price = seen_price > 0.0 ? seen_price / microseconds_of_ray : price;
  AuditGoal own = goal.among_rays_of(own_price);
  own.rays -= std::min(own.rays, rays);
  const auto measure = [&](std::uint64_t points, std::uint32_t paths, Measured& to) {
    const std::uint32_t side = PixelDraw::side(points);
    to.samples.assign(PixelDraw::size(side), {});
    const std::uint64_t first = std::exchange(keys, keys + to.samples.size());
    parallel_in_batches(
        control, thread_count(threads), to.samples.size(), {512, 4},
        [&](std::size_t i) { to.samples[i] = measure_pixel(series, first + i, i, side, paths); },
        [&](std::size_t done) { control.report("audit", static_cast<double>(done) / static_cast<double>(to.samples.size())); });
    for (const Sample& sample : to.samples) {
      rays += sample.rays;
      to.rays += sample.rays;
      const double w = sample.weight;
      if (sample.valid) { to.sums.add(w * sample.square, w * sample.reference, w * w * sample.noise); }
      reflects = reflects || sample.valid;
    }
    return !control.cancelled();
  };
  Measured steering;
  const std::uint64_t before = rays;
  if (own.rays_to_steer > 0 && !measure(steering_points, steering_paths(own), steering)) { return std::nullopt; }
  const auto sums = [](const Measured& m) -> const ErrorSums& { return m.sums; };
  if (!measure_to_goal<Measured>(measure, sums, own, measured)) { return std::nullopt; }
  const std::optional<ErrorEstimate> error = measured.sums.estimate();
  if (!error && reason) {
    *reason =
        reflects ? "hardly any path from its pixels meets light that could be compared with it" : "it shows no surface that does not shine";
  }
  if (!error) { return std::nullopt; }
  const std::uint64_t rays_of_goal = rays - before - steering.rays;
  PictureError result;
  result.error = *error;
  result.points = measured.sums.square.size();
  result.rays = rays;
  result.reserve_used = static_cast<std::uint64_t>(own_price * static_cast<double>(used_of_reserve(own, rays_of_goal)));
  double all = 0.0;
  for (const Sample& sample : measured.samples) {
    all += sample.weight;
    result.audited += sample.valid ? sample.weight : 0.0;
  }
  result.audited /= all;
  const std::array<ShareBounds, 2> shares = shares_off(picture, measured);
  result.over2 = shares[0], result.over8 = shares[1];
  result.worst = worst_tile(picture, measured);
  // The worst tile is no better than the whole: then most of the error is where too few of the pixels lie for a tile of their own.
  if (result.worst && result.worst->error.high < error->low) { result.worst.reset(); }
  result.steering = steering.sums.estimate();
  result.picture_work = picture_worth(price, picture.width, picture.height);
  return result;
}

HALFLIGHT_INLINE PictureAudit::PictureAudit(const Scene& scene, const LightUnit& unit, Prepared prepared)
    : unit_{unit}, prepared_{std::make_unique<Prepared>(std::move(prepared))}, tracer_{scene, prepared_->objects, prepared_->surfaces} {
  const auto inputs = surfaces(scene);
  all_emit_ =
      std::none_of(inputs.begin(), inputs.end(), [&](const InputSurface& s) { return is_black(scene.materials[s.material].emission); });
}

HALFLIGHT_INLINE std::optional<raycast::ScenePoint> PictureAudit::seen(const ShownPicture& picture, double x, double y,
                                                                       std::uint64_t& rays) const {
  const raycast::Scene& objects = prepared_->objects;
  raycast::Segment ray = picture.ray(x, y);
  ray.origin = (ray.origin - prepared_->frame.centre) * prepared_->frame.scale;
  ray.direction = glm::normalize(ray.direction) * objects.diameter();
  std::uint32_t from = raycast::no_object, sheet = raycast::unknown_sheet;
  constexpr int most = 10'000;  // limit: only back faces are passed, but rounding might repeat one endlessly
  for (int passed = 0; passed < most; ++passed) {
    ++rays;
    const auto hit = objects.closest(ray, from, sheet);
    if (!hit) { return std::nullopt; }
    const raycast::ScenePoint point = objects.point(*hit, ray);
    if (hit->front && !objects.covered(point)) { return point; }
    ray.origin = point.position;
    from = hit->object;
    sheet = hit->sheet;
  }
  return std::nullopt;
}

HALFLIGHT_INLINE std::optional<Color> PictureAudit::emitted(const ShownPicture& picture, std::uint32_t x, std::uint32_t y,
                                                            std::uint64_t& rays) const {
  if (picture.partly_lamp && picture.partly_lamp(x, y)) { return std::nullopt; }
  bool sees = false;
  Color emitted{0.0};
  // The 25 rays reach somewhat beyond the pixel, too: few paths would miss a lamp that covers only a sliver of it but shows in the picture.
  for (std::uint32_t k = 0; k < 25; ++k) {
    const auto at = seen(picture, x - 0.25 + 0.375 * (k % 5), y - 0.25 + 0.375 * (k / 5), rays);
    const Color own = at ? tracer_.of(*at).emission : Color{0.0};  // a ray that leaves the scene meets no emission
    if (k == 0) { emitted = own; }
    if (own != emitted || (!all_emit_ && !is_black(own))) { return std::nullopt; }
    sees = sees || at.has_value();
  }
  return sees ? std::optional{emitted} : std::nullopt;
}

namespace detail {

// The picture divided by the power of two that scales its brightest channel to [1, 2), so that squares are finite in any unit of light.
// Pixels that are not finite count as black.
[[nodiscard]] HALFLIGHT_INLINE std::vector<Color> in_its_own_unit(const ShownPicture& picture) {
  std::vector<Color> radiosity(std::size_t{picture.width} * picture.height);
  double most = 0.0;
  for (std::size_t p = 0; p < radiosity.size(); ++p) {
    const Color shown = picture.radiosity(static_cast<std::uint32_t>(p % picture.width), static_cast<std::uint32_t>(p / picture.width));
    radiosity[p] = brep::is_finite(shown) ? shown : Color{0.0};
    most = std::max(most, brightest(radiosity[p]));
  }
  const double unit = most > 0.0 ? std::ldexp(1.0, -std::ilogb(most)) : 1.0;
  for (Color& b : radiosity) { b *= unit; }
  return radiosity;
}

}  // namespace detail

HALFLIGHT_INLINE PixelDraw PictureAudit::draw_of(const ShownPicture& picture, std::uint64_t most, std::uint64_t& rays,
                                                 const Control& control) const {
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  const std::vector<Color> radiosity = detail::in_its_own_unit(picture);
  const auto square = [&](std::size_t p) { return glm::dot(radiosity[p], radiosity[p]); };
  std::vector<std::size_t> order(pixels);
  double rest = 0.0;  // importance of the pixels that have not been visited yet
  for (std::size_t p = 0; p < pixels; ++p) {
    order[p] = p;
    rest += square(p);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return std::pair{square(b), a} < std::pair{square(a), b}; });
  // Excluding a pixel pays only if more than one in so many points would fall on it; but a lamp has many equally bright pixels, so they
  // are visited until `enough` pixels in a row count.
  constexpr double many = 4096.0;
  constexpr int enough = 64;  // pixels in a row that count: no more lamps follow
  std::vector<char> left_out(pixels, 0);
  double kept = 0.0;
  std::optional<Color> of_lamp;  // radiosity of the last pixel that did not count; most pixels of a lamp have the same
  int in_a_row = 0;
  for (std::size_t k = 0; k < pixels && rays < most && !control.cancelled(); ++k) {
    const std::size_t p = order[k];
    if (in_a_row >= enough && many * square(p) <= kept + rest) { break; }
    rest -= square(p);
    const auto x = static_cast<std::uint32_t>(p % picture.width), y = static_cast<std::uint32_t>(p / picture.width);
    const bool counts = of_lamp != radiosity[p] && emitted(picture, x, y, rays).has_value();
    in_a_row = counts ? in_a_row + 1 : 0;
    left_out[p] = counts ? 0 : 1;
    kept += counts ? square(p) : 0.0;
    if (!counts) { of_lamp = radiosity[p]; }
  }
  return {picture.width, picture.height, pixel_importance(picture.width, picture.height, radiosity, left_out)};
}

HALFLIGHT_INLINE bool PictureAudit::aiming_pays(const Series& plain, const PathTracer& aimed, unsigned threads, std::uint64_t& rays) const {
  const std::uint32_t side = PixelDraw::side(128);
  const auto start = [&](std::uint32_t i) -> std::optional<PathStart> {
    Random random{plain.seed, i, 0x61696d696e67ull};
    const PixelDraw::Pixel pixel = plain.draw.draw(i, side, random);
    std::uint64_t own = 0;
    const auto at = seen(plain.picture, pixel.x + 0.5, pixel.y + 0.5, own);
    if (!at || (!all_emit_ && !is_black(tracer_.of(*at).emission))) { return std::nullopt; }
    return PathStart{*at, pixel.weight};
  };
  const auto points = static_cast<std::uint32_t>(PixelDraw::size(side));
  const AimingTry tried = try_aiming(plain.tracer, aimed, plain.seed, points, thread_count(threads), start);
  rays += tried.rays;
  return tried.pays;
}

HALFLIGHT_INLINE PictureAudit::Sample PictureAudit::measure_pixel(const Series& series, std::uint64_t key, std::size_t i,
                                                                  std::uint32_t side, std::uint32_t paths) const {
  const ShownPicture& picture = series.picture;
  Sample sample;
  Random random{series.seed, key, 0x706978656cull};
  const PixelDraw::Pixel pixel = series.draw.draw(i, side, random);
  sample.x = pixel.x;
  sample.y = pixel.y;
  sample.weight = pixel.weight;
  const std::optional<Color> emits = emitted(picture, sample.x, sample.y, sample.rays);
  if (!emits) { return sample; }
  bool edge = false;  // does the edge of a lamp run through this pixel?
  const PathEstimates light{series.seed, key, paths, [&](PathNumbers& numbers) -> PathTracer::Light {
                              const double u = numbers.uniform();
                              const auto at = seen(picture, sample.x + u, sample.y + numbers.uniform(), sample.rays);
                              edge = edge || (at ? tracer_.of(*at).emission : Color{0.0}) != *emits;
                              if (!at) { return {}; }
                              return series.tracer.radiosity(*at, numbers, sample.rays);
                            }};
  if (edge) { return sample; }
  const Color shown = unit_.to_unit(picture.radiosity(sample.x, sample.y));
  const auto level = [&](double b) { return picture.level(unit_.to_watts(Color{b}).x); };
  sample.square = light.square_off(shown);
  sample.reference = light.square_off(*emits);
  sample.noise = light.noise();
  const Color halves[2] = {light.half(0), light.half(1)};
  for (int c = 0; c < 3; ++c) {
    const double off = level(0.5 * (halves[0][c] + halves[1][c])) - level(shown[c]);
    sample.levels = std::max(sample.levels, std::abs(off));
    const double one = level(halves[0][c]) - level(shown[c]), other = level(halves[1][c]) - level(shown[c]);
    sample.most_levels = std::max({sample.most_levels, std::abs(one), std::abs(other)});
    if (one * other > 0.0) { sample.least_levels = std::max(sample.least_levels, std::min(std::abs(one), std::abs(other))); }
    sample.noise_in_levels = std::max(sample.noise_in_levels, std::abs(one - other));
    sample.square_in_levels += one * other;
  }
  sample.valid = true;
  return sample;
}

HALFLIGHT_INLINE double PictureAudit::ray_price(const Series& series) const {
  const std::uint32_t side = PixelDraw::side(256);
  PathTracer::RayCost cost;
  for (std::size_t i = 0; i < PixelDraw::size(side); ++i) {
    Random random{series.seed, i, 0x7072696365ull};
    const PixelDraw::Pixel pixel = series.draw.draw(i, side, random);
    std::uint64_t rays = 0;
    const auto at = seen(series.picture, pixel.x + 0.5, pixel.y + 0.5, rays);
    if (!at) { continue; }
    static_cast<void>(series.tracer.radiosity(*at, random, cost));
  }
  return cost.mean();
}

HALFLIGHT_INLINE std::array<ShareBounds, 2> PictureAudit::shares_off(const ShownPicture& picture, const Measured& measured) {
  // Two standard errors of the mean of both estimates equal the RMS difference between them, taken over the pixels of a tile. Three are
  // used: with two, five of a hundred correct pixels would seem wrong. For n pixels the equivalent Student quantile is
  // 3 + 7.5 / n + 17 / n^2 (Abramowitz and Stegun 26.7.5).
  std::array<double, 16> doubt{}, count{}, pixels{};
  double all = 0.0;
  ErrorSums squares;
  for (const Sample& sample : measured.samples) {
    if (!sample.valid) { continue; }
    doubt[tile(picture, sample)] += sample.weight * sample.noise_in_levels * sample.noise_in_levels;
    count[tile(picture, sample)] += sample.weight;
    pixels[tile(picture, sample)] += 1.0;
    all += sample.weight;
    squares.add(sample.weight * sample.square_in_levels, sample.weight, 0.0);
  }
  for (std::size_t t = 0; t < 16; ++t) {
    const double n = pixels[t];
    doubt[t] = n > 0.0 ? 0.5 * (3.0 + 7.5 / n + 17.0 / (n * n)) * std::sqrt(doubt[t] / count[t]) : 0.0;
  }
  // Upper bound that holds however noisy a pixel is: the mean square limits the share of pixels that are so far off (Chebyshev).
  const std::optional<ErrorEstimate> rms = squares.estimate();
  const auto allowed = [&](double levels) { return rms ? rms->high * rms->high / (levels * levels) : 1.0; };
  // A second upper bound: at most twice as many pixels are so far off as either estimate alone shows. Each estimate errs away from the
  // picture's value in at least 3 of 10 pixels, even if its noise is mostly small and seldom large, and then it shows the deviation.
  const auto share = [&](double levels) {
    ShareBounds bounds;
    double seen = 0.0;
    for (const Sample& sample : measured.samples) {
      if (!sample.valid) { continue; }
      const double by_noise = doubt[tile(picture, sample)], one = sample.weight / all;
      bounds.least += std::min(sample.levels - by_noise, sample.least_levels) > levels ? one : 0.0;
      bounds.most += sample.levels + by_noise > levels ? one : 0.0;
      seen += sample.most_levels > levels ? one : 0.0;
    }
    bounds.most = std::max(bounds.least, std::min({bounds.most, allowed(levels), 2.0 * seen}));
    return bounds;
  };
  return {share(2.0), share(8.0)};
}

HALFLIGHT_INLINE std::optional<PictureError::Tile> PictureAudit::worst_tile(const ShownPicture& picture, const Measured& measured) {
  double mean_reference = 0.0;
  double all = 0.0;
  for (const Sample& sample : measured.samples) {
    if (!sample.valid) { continue; }
    mean_reference += sample.weight * sample.reference;
    all += sample.weight;
  }
  mean_reference /= all;
  std::array<ErrorSums, 16> tiles;
  for (const Sample& sample : measured.samples) {
    const double w = sample.weight;
    if (sample.valid) { tiles[tile(picture, sample)].add(w * sample.square, w * mean_reference, w * w * sample.noise); }
  }
  std::optional<PictureError::Tile> worst;
  for (std::uint32_t t = 0; t < tiles.size(); ++t) {
    const std::optional<ErrorEstimate> of_tile = tiles[t].square.size() >= 16 ? tiles[t].estimate() : std::nullopt;
    if (of_tile && (!worst || of_tile->low > worst->error.low)) { worst = PictureError::Tile{t % 4, t / 4, *of_tile}; }
  }
  return worst;
}

}  // namespace radiosity
