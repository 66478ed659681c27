// SPDX-License-Identifier: MIT
#pragma once

// Interpolates indirect light over a picture from sparse points (radiosity/picture/gathered_point.hpp): dense in corners and at contacts,
// sparse on open walls. The radius of a point's sphere is limited below and above in pixels, as is that of its fit, and by the distance
// from the nearest contact that the picture shows (contacts.hpp). Points are stored by tiles of the picture. A pixel blends the points
// whose spheres contain it, with weights that fall to 0 at their borders.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct IndirectPoint : GatheredPoint {
  std::uint32_t x = 0, y = 0;                // its pixel
  double pixels = 0.0, widest_pixels = 0.0;  // radii of both spheres, in pixels; upper bounds
  double least_widest = 0.0;                 // lower limit of `widest`
};

// A point made from the light gathered at a place seen through this pixel. `pixel_size`: width of a pixel at the place, m.
[[nodiscard]] IndirectPoint indirect_point(const FinalGather::Indirect& found, const std::array<std::uint32_t, 2>& pixel,
                                           const FinalGather::Place& place, const glm::dvec3& eye, double pixel_size);
// Makes the radius of a point's sphere at most this, but not less than a pixel.
void limit_radius(IndirectPoint& point, double most);

class IndirectPoints {
 public:
  IndirectPoints(std::uint32_t width, std::uint32_t height);

  // Makes room for so many points more, and for none beyond them.
  void reserve(std::size_t more) { points_.reserve(points_.size() + more); }
  void add(const IndirectPoint& point);
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  // What the lists of the tiles take; a growing one is at most half empty.
  [[nodiscard]] std::size_t bytes_of_tiles() const { return 2 * sizeof(std::uint32_t) * in_lists_; }
  // At most, with the table from which it is added, and the old place of a table that is moved because it grows.
  static constexpr std::size_t bytes_of_point = 2 * sizeof(IndirectPoint);

  // Is the place within the inner part of some point's sphere, so that no further point is needed?
  [[nodiscard]] bool covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                             std::uint32_t object) const;
  // Calls gather(i) again at the points whose value is likely to be noise (gathered_point.hpp). Call it once all points have been added.
  // Returns false when cancelled.
  template <class Gather>
  [[nodiscard]] bool gather_again(unsigned threads, const Control& control, const Gather& gather);
  // Fits point i, once all have been added; different points may be fitted in parallel.
  void fit(std::size_t i);
  // Interpolated irradiance, once all points are fitted. Nothing if no sphere contains the place.
  [[nodiscard]] std::optional<Color> at(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                                        std::uint32_t object) const;

 private:
  static constexpr std::uint32_t tile = 8;  // pixels
  using Tiles = std::vector<std::vector<std::uint32_t>>;
  [[nodiscard]] const std::vector<std::uint32_t>& near(std::uint32_t x, std::uint32_t y) const {
    return tiles_[std::size_t{y / tile} * columns_ + x / tile];
  }
  // The points in the widest sphere of this point, including itself.
  [[nodiscard]] std::vector<const GatheredPoint*> around(const IndirectPoint& point) const;
  // Calls visit(tile) for all tiles within `pixels` of the point.
  template <class Visit>
  void each_tile(const IndirectPoint& point, double pixels, const Visit& visit) const;

  std::uint32_t columns_, rows_;
  std::vector<IndirectPoint> points_;
  Tiles tiles_;               // by tile: points whose spheres may overlap it
  Tiles in_tiles_;            // by tile: points that lie in it
  std::size_t in_lists_ = 0;  // the length of all lists together
};

template <class Gather>
bool IndirectPoints::gather_again(unsigned threads, const Control& control, const Gather& gather) {
  std::vector<char> doubtful(points_.size());
  const auto doubt = [&](std::size_t i) { doubtful[i] = is_doubtful(points_[i], around(points_[i])) ? 1 : 0; };
  if (!parallel_in_batches(control, threads, points_.size(), {points_.size(), 64}, doubt)) { return false; }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < doubtful.size(); ++i) {
    if (doubtful[i] != 0) { chosen.push_back(i); }
  }
  return parallel_in_batches(control, threads, chosen.size(), {256, 4}, [&](std::size_t k) {
    IndirectPoint& point = points_[chosen[k]];
    const FinalGather::Indirect found = gather(chosen[k]);
    point.gathered = found.irradiance;
    point.variance = found.variance;
  });
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/indirect_points.cpp>
#endif
