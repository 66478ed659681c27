// SPDX-License-Identifier: MIT
#pragma once

// Where the light of bright spots arrives: photons sent out by the spots, each with its group of spots (photon map; Jensen 1996). Most of
// a spot may be hidden from a point: a slit lets through only a thin strip of light. So the photons that landed around a point tell which
// groups it sees and how much light these send there, and rays are aimed accordingly ("Importance driven path tracing using the photon
// map", Jensen 1995). Photons only guide sampling and carry no light into the result.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity {

class SpotPhotons {
 public:
  struct Photon {
    glm::dvec3 position{0.0}, normal{0.0};  // of the place where it landed
    std::uint32_t group = 0;
    double power = 0.0;  // W, sum of channels
  };

  SpotPhotons() = default;
  // `reach`: photons farther away than this from a query are ignored.
  SpotPhotons(std::vector<Photon> photons, double reach);

  // The nearest photons around a point, at most `most_found`, that landed on surfaces of about the same orientation (of any, if `normal`
  // is null); and the radius of the disk that contains them.
  static constexpr std::size_t most_found = 48;
  struct Found {
    std::vector<std::uint32_t> photons;
    double radius = 0.0;
  };
  [[nodiscard]] Found around(const glm::dvec3& position, const glm::dvec3* normal) const;
  [[nodiscard]] const Photon& operator[](std::uint32_t i) const { return photons_[i]; }

 private:
  // Sorts the photons so that each range has its median in the middle, along the axis on which it is widest (kd-tree; Bentley 1975).
  void sort(std::size_t first, std::size_t last);

  std::vector<Photon> photons_;
  std::vector<std::uint8_t> axis_;  // split axis of each photon's range
  double reach_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/spot_photons.cpp>
#endif
