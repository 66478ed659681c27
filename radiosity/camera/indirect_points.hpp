// SPDX-License-Identifier: MIT
#pragma once

// Indirect light over a picture from points that lie apart (radiosity/picture/gathered_point.hpp): close together in corners and at
// contacts, far apart on open walls. The radius of a point's sphere is held between some pixels and some more, that of its fit below three
// times as many. Points are looked for in tiles of the picture; a pixel blends the points whose spheres hold it, with weights that fall to
// 0 towards their borders.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

struct IndirectPoint : GatheredPoint {
  std::uint32_t x = 0, y = 0;                // its pixel
  double pixels = 0.0, widest_pixels = 0.0;  // radii of both spheres in the picture, at most
};

class IndirectPoints {
 public:
  IndirectPoints(std::uint32_t width, std::uint32_t height);

  void add(const IndirectPoint& point);
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  // Is a place within the inner part of some point's sphere, so that no further point is needed?
  [[nodiscard]] bool covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                             std::uint32_t object) const;
  // Fits point i, once all are there; others may be fitted at the same time.
  void fit(std::size_t i);
  // Once all are fitted. Nothing where no sphere holds the place.
  [[nodiscard]] std::optional<Color> at(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                                        std::uint32_t object) const;

 private:
  static constexpr std::uint32_t tile = 8;  // pixels
  using Tiles = std::vector<std::vector<std::uint32_t>>;
  [[nodiscard]] const std::vector<std::uint32_t>& near(std::uint32_t x, std::uint32_t y) const {
    return tiles_[std::size_t{y / tile} * columns_ + x / tile];
  }
  // Calls visit(tile) for all tiles within so many pixels of a point.
  template <class Visit>
  void each_tile(const IndirectPoint& point, double pixels, const Visit& visit) const;

  std::uint32_t columns_, rows_;
  std::vector<IndirectPoint> points_;
  Tiles tiles_;     // points whose spheres may show in the tile
  Tiles in_tiles_;  // points that lie in the tile
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/indirect_points.cpp>
#endif
