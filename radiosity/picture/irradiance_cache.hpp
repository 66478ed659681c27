// SPDX-License-Identifier: MIT
#pragma once

// Indirect light anywhere on the surfaces of a scene, interpolated between sparse points (gathered_point.hpp): dense in corners and at
// contacts, sparse on open walls. Points are stored in the cells of grids, one grid for each power of two of the spheres' radii.
//
// The cache grows with the requested places; its values depend on these and their order alone, not on the number of threads.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

class IrradianceCache {
 public:
  // `light` must outlive this.
  IrradianceCache(const FinalGather& light, unsigned threads) : light_{&light}, threads_{threads} {}

  struct Wanted {
    FinalGather::Place place;
    double least_radius = 0.0, most_radius = 0.0;  // limits of the radius of a point made for it; in the frame
  };
  // Gathers more points until there is one near each of these places. False when cancelled.
  [[nodiscard]] bool extend(std::span<const Wanted> wanted, const Control& control);

  // Irradiance near a place for which the cache was extended, W/m2.
  [[nodiscard]] std::optional<Color> at(const FinalGather::Place& place) const;

 private:
  [[nodiscard]] bool covered(const FinalGather::Place& place) const;
  [[nodiscard]] GatheredPoint gather(const Wanted& wanted) const;
  void add(const GatheredPoint& point);
  void fit_all();
  // Calls visit(index) for the points whose spheres may contain the position, and possibly for others.
  template <class Visit>
  void each_near(const glm::dvec3& position, const Visit& visit) const;

  const FinalGather* light_;
  unsigned threads_;
  std::vector<GatheredPoint> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  // by the hash of grid and cell
  std::vector<int> grids_;                                               // exponents of two, ascending
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/irradiance_cache.cpp>
#endif
