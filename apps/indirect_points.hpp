// SPDX-License-Identifier: MIT
#pragma once

// Indirect light over a picture from points that lie apart (irradiance cache; Ward, Rubinstein and Clear 1988): it changes within the
// distance of what a point sees, so points are close together in corners and at contacts, and far apart on open walls.
//
// Each point holds the light that was gathered there, and is good for a ball around it: of the radius that its distances allow, but not
// below some pixels, nor beyond some more. Points are looked for in tiles of the picture. The light of a point and how it changes are taken
// from all points in its ball (weighted least squares), which also takes out most of the noise of the rays; a pixel blends the points whose
// balls hold it, with weights that fall to 0 towards their borders.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

namespace apps {

struct IndirectPoint {
  glm::dvec3 position{0.0}, normal{0.0};
  std::uint32_t object = 0;
  std::uint32_t x = 0, y = 0;  // its pixel
  double radius = 0.0;         // of the ball, in the unit of the position
  double pixels = 0.0;         // the same in the picture, at most
  radiosity::Color gathered{0.0};
  // What the fit makes of it: the light at the point, and its change by length along two tangents.
  radiosity::Color light{0.0};
  glm::dvec3 s{0.0}, t{0.0};
  radiosity::Color by_s{0.0}, by_t{0.0};
};

class IndirectPoints {
 public:
  IndirectPoints(std::uint32_t width, std::uint32_t height);

  void add(const IndirectPoint& point);
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  // Is a place within the inner part of some point's ball, so that no further point is needed?
  [[nodiscard]] bool covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                             std::uint32_t object) const;
  // Fits point i; others may be fitted at the same time.
  void fit(std::size_t i);
  // Once all are fitted. Nothing where no ball holds the place.
  [[nodiscard]] std::optional<radiosity::Color> at(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                                                   std::uint32_t object) const;

 private:
  static constexpr std::uint32_t tile = 8;  // pixels
  [[nodiscard]] const std::vector<std::uint32_t>& near(std::uint32_t x, std::uint32_t y) const {
    return tiles_[std::size_t{y / tile} * columns_ + x / tile];
  }

  std::uint32_t columns_, rows_;
  std::vector<IndirectPoint> points_;
  std::vector<std::vector<std::uint32_t>> tiles_;  // points whose balls may show in the tile
};

}  // namespace apps
