// SPDX-License-Identifier: MIT
#pragma once

// The error of a picture: surfaces that the camera does not see do not count, and surfaces that fill many pixels count much. Half of the
// pixels are drawn uniformly, half where the picture is bright or changes (pixel_draw.hpp). The true value of a pixel is the mean of the
// path-traced radiosity over its square, estimated twice independently (error_estimate.hpp). Pixels that show a lamp are left out (unless
// every surface emits), because emitted light is exact by definition and would dominate the norm; pixels that see nothing are left out,
// too. Errors are relative to the reflected radiosity. How the picture was made does not matter.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <raycast/object.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/pixel_draw.hpp>
#include <radiosity/audit/shown_picture.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

class PictureAudit {
 public:
  // Nothing for an invalid scene, or for one in which paths do not end (plan.hpp).
  [[nodiscard]] static std::optional<PictureAudit> make(const Scene& scene);

  // Nothing when cancelled or when the error cannot be measured; then `reason` receives a sentence that says why, if given. `rays`: see
  // AuditGoal. The result depends on picture, goal and seed alone.
  [[nodiscard]] std::optional<PictureError> measure(const ShownPicture& picture, const AuditGoal& goal, unsigned threads,
                                                    std::uint64_t seed, const Control& control = {}, std::string* reason = nullptr) const;

  // The cost of a ray of a path, relative to a scene of few polygons.
  [[nodiscard]] double ray_work() const { return prepared_->objects.ray_work() + prepared_->objects.walk_work(); }

 private:
  struct Sample {
    std::uint32_t x = 0, y = 0;
    double weight = 1.0;
    double square = 0.0, reference = 0.0, noise = 0.0;
    double levels = 0.0, noise_in_levels = 0.0;  // largest channel difference from the truth; between the two estimates
    // The same difference by the estimate that is nearer (0 if the two lie on both sides), and by the other one.
    double least_levels = 0.0, most_levels = 0.0;
    double square_in_levels = 0.0;  // as `square`, of all channels
    std::uint64_t rays = 0;
    bool valid = false;
  };
  struct Measured {
    std::vector<Sample> samples;
    ErrorSums sums;
    std::uint64_t rays = 0;
  };

  PictureAudit(const Scene& scene, const LightUnit& unit, Prepared prepared);

  // The first surface that faces the camera; back faces are looked through, as in the pictures (lookup.hpp).
  [[nodiscard]] std::optional<raycast::ScenePoint> seen(const ShownPicture& picture, double x, double y, std::uint64_t& rays) const;

  // The emitted light, when it is the same all over the pixel. Nothing when the pixel does not count because it sees nothing or shows a
  // lamp.
  [[nodiscard]] std::optional<Color> emitted(const ShownPicture& picture, std::uint32_t x, std::uint32_t y, std::uint64_t& rays) const;

  // What is measured, and how.
  struct Series {
    const ShownPicture& picture;
    const PixelDraw& draw;
    const PathTracer& tracer;
    std::uint64_t seed = 0;
  };

  // The probability with which each pixel is drawn. Bright pixels that do not count, such as lamps, are searched for first with about
  // `most` rays, and are never drawn, because drawing them would be wasted. Which of them are found changes where pixels are drawn, not
  // the expected value.
  [[nodiscard]] PixelDraw draw_of(const ShownPicture& picture, std::uint64_t most, std::uint64_t& rays, const Control& control) const;

  // Does aiming the paths pay (aimed_paths.hpp)? Adds the rays of the trial to `rays`.
  [[nodiscard]] bool aiming_pays(const Series& plain, const PathTracer& aimed, unsigned threads, std::uint64_t& rays) const;

  [[nodiscard]] Sample measure_pixel(const Series& series, std::uint64_t key, std::size_t i, std::uint32_t side, std::uint32_t paths) const;

  // The cost of a path-tracing ray from visible points (PathTracer::RayCost): the mean over 256 pixels drawn as in the audit.
  [[nodiscard]] double ray_price(const Series& series) const;

  [[nodiscard]] static std::size_t tile(const ShownPicture& picture, const Sample& sample) {
    return 4 * (std::size_t{4} * sample.y / picture.height) + std::size_t{4} * sample.x / picture.width;
  }

  // Shares of the pixels that are more than 2 and 8 levels off.
  [[nodiscard]] static std::array<ShareBounds, 2> shares_off(const ShownPicture& picture, const Measured& measured);
  [[nodiscard]] static std::optional<PictureError::Tile> worst_tile(const ShownPicture& picture, const Measured& measured);

  LightUnit unit_;
  std::unique_ptr<Prepared> prepared_;  // the tracer points into it
  PathTracer tracer_;
  bool all_emit_ = false;  // does every surface emit?
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/picture_error.cpp>
#endif
