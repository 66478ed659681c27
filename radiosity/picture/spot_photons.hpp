// SPDX-License-Identifier: MIT
#pragma once

// Where the light of bright spots arrives: photons that they send out, each with the group of spots that it comes from (photon map; Jensen
// 1996). Of what a point may see of a spot something else often hides most: a slit lets through the light of a thin strip of what is behind
// it. So the photons that land around a point tell which groups it sees and how much light they send there, and rays are aimed by that
// ("Importance driven path tracing using the photon map", Jensen 1995). They guide alone: no light is taken from them.

#include <cstddef>
#include <cstdint>
#include <span>
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
  // `reach`: photons that landed farther away than this are not asked.
  SpotPhotons(std::vector<Photon> photons, double reach);

  [[nodiscard]] bool empty() const { return photons_.empty(); }

  // The photons around a point that landed on what faces about the same way (any way, without a normal): the nearest ones, as many as
  // `most_found` at most, and the radius of the disk on which they landed.
  static constexpr std::size_t most_found = 48;
  struct Found {
    std::vector<std::uint32_t> photons;
    double radius = 0.0;
  };
  [[nodiscard]] Found around(const glm::dvec3& position, const glm::dvec3* normal) const;
  [[nodiscard]] const Photon& operator[](std::uint32_t i) const { return photons_[i]; }

 private:
  // Sorts photons so that each range has its median in the middle, along the axis on which it is widest (kd-tree; Bentley 1975).
  void sort(std::size_t first, std::size_t last);

  std::vector<Photon> photons_;
  std::vector<std::uint8_t> axis_;  // on which each photon parts those of its range
  double reach_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/spot_photons.cpp>
#endif
