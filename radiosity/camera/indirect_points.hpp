// SPDX-License-Identifier: MIT
#pragma once

// Indirect light over a picture from points that lie apart (radiosity/picture/gathered_point.hpp): close together in corners and at
// contacts, far apart on open walls. The radius of a point's sphere is held between some pixels and some more, that of its fit below three
// times as many. Points are looked for in tiles of the picture; a pixel blends the points whose spheres hold it, with weights that fall to
// 0 towards their borders.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

struct IndirectPoint : GatheredPoint {
  std::uint32_t x = 0, y = 0;                // its pixel
  double pixels = 0.0, widest_pixels = 0.0;  // radii of both spheres in the picture, at most
};

// What was gathered at a place that this pixel shows; a pixel has this size there.
[[nodiscard]] IndirectPoint indirect_point(const FinalGather::Indirect& found, const std::array<std::uint32_t, 2>& pixel,
                                           const FinalGather::Place& place, const glm::dvec3& eye, double pixel_size);

class IndirectPoints {
 public:
  IndirectPoints(std::uint32_t width, std::uint32_t height);

  void add(const IndirectPoint& point);
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  // Is a place within the inner part of some point's sphere, so that no further point is needed?
  [[nodiscard]] bool covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                             std::uint32_t object) const;
  // Gathers once more, by gather(i), at the points where what was gathered is likely to be noise (gathered_point.hpp), once all are there.
  // False when cancelled.
  template <class Gather>
  [[nodiscard]] bool gather_again(unsigned threads, const Control& control, const Gather& gather);
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
  // The points in the widest sphere of this one, itself among them.
  [[nodiscard]] std::vector<const GatheredPoint*> around(const IndirectPoint& point) const;
  // Calls visit(tile) for all tiles within so many pixels of a point.
  template <class Visit>
  void each_tile(const IndirectPoint& point, double pixels, const Visit& visit) const;

  std::uint32_t columns_, rows_;
  std::vector<IndirectPoint> points_;
  Tiles tiles_;     // points whose spheres may show in the tile
  Tiles in_tiles_;  // points that lie in the tile
};

template <class Gather>
bool IndirectPoints::gather_again(unsigned threads, const Control& control, const Gather& gather) {
  std::vector<char> doubtful(points_.size());
  parallel_for(
      points_.size(), threads, [&](std::size_t i) { doubtful[i] = is_doubtful(points_[i], around(points_[i])) ? 1 : 0; }, 64);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < doubtful.size(); ++i) {
    if (doubtful[i] != 0) { chosen.push_back(i); }
  }
  constexpr std::size_t batch = 256;  // between two looks at the cancel flag
  for (std::size_t first = 0; first < chosen.size(); first += batch) {
    if (control.cancelled()) { return false; }
    const auto each = [&](std::size_t k) {
      IndirectPoint& point = points_[chosen[first + k]];
      const FinalGather::Indirect found = gather(chosen[first + k]);
      point.gathered = found.irradiance;
      point.variance = found.variance;
    };
    parallel_for(std::min(batch, chosen.size() - first), threads, each, 4);
  }
  return true;
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/indirect_points.cpp>
#endif
