// SPDX-License-Identifier: MIT
#pragma once

// Finds small places that reflect much of a scene's light: the inside of a lamp's shade, the ceiling above a lamp, a table in a narrow
// beam. A path that continues in a cosine-distributed direction hits such a place rarely and then counts for all the paths that missed
// it, which is noise. So a share of the paths continues towards one of these places.
//
// The places are where photons of the lamps land densely. Which places light a given point is told by photons that the places send on
// ("Importance driven path tracing using the photon map", Jensen 1995). All this only proposes directions: the light from a direction is
// found by the path itself, and each direction has a density(), so that the estimate stays unbiased (Veach and Guibas 1995). No solution
// is used here.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/geometry/photon_grid.hpp>

namespace radiosity {

class BrightPlaces {
 public:
  // Light that landed on a surface and is reflected from there.
  struct Reflected {
    raycast::ScenePoint from;
    double power = 0.0;  // sum of the channels, in any unit
  };

  // No places.
  BrightPlaces() = default;
  struct Use {
    double area = 0.0, diameter = 0.0;  // of the scene: m^2, m
    double share = 0.0;                 // share of the directions that are aimed at the places
    std::uint32_t photons = 0;          // number of photons that the places send on
  };
  // Stays empty when the places would hold little of the light or are not small.
  BrightPlaces(std::vector<Reflected> light, const Use& use, const MeetFront& meet);

  [[nodiscard]] bool empty() const { return places_.empty(); }

  // Cost of a From for one reflection, in microseconds of a core of 2024.
  [[nodiscard]] double work() const { return 0.03 * static_cast<double>(places_.size()); }

  static constexpr std::size_t most_places = 24;  // limit, because every direction's density is a sum over all places

  // Distribution of the directions in which a path may continue from a surface point: cosine-distributed, or, with probability
  // `share`, towards a place.
  class From {
   public:
    From(const BrightPlaces& places, const glm::dvec3& position, const glm::dvec3& normal);
    // Draws a direction from `random`; nothing if it points into the surface.
    template <class Numbers>
    [[nodiscard]] std::optional<glm::dvec3> direction(Numbers& random) const {
      const double choice = share_ > 0.0 ? random.uniform() : 1.0;
      const double u = random.uniform();
      return direction(choice, u, random.uniform());
    }
    // Density per solid angle of the unit direction w. Its integral may be less than 1, because some draws give no direction.
    [[nodiscard]] double density(const glm::dvec3& w) const;

   private:
    [[nodiscard]] std::optional<glm::dvec3> direction(double choice, double u, double v) const;

    // The cone around the bounding sphere of a place. Its members have no initializers because every path creates many of these.
    struct Cone {
      glm::dvec3 axis;  // not of length 1
      double square, sine2, chance;
    };
    [[nodiscard]] double density_of(const Cone& cone, const glm::dvec3& w) const;

    glm::dvec3 normal_{0.0};
    std::array<Cone, most_places> cones_;
    std::size_t count_ = 0;
    double share_ = 0.0;
  };

 private:
  struct Place {
    std::uint32_t first = 0, last = 0;  // range of the light that made it
    double power = 0.0;
    glm::dvec3 centre{0.0};
    double radius = 0.0;   // of the bounding sphere
    double squares = 0.0;  // mean square distance of the light from the centre
    int axis = 0;          // along which it extends farthest: 0 to 2 are x, y, z of the position, 3 to 5 of the normal

    // Approximate area on which the light landed, taken as a disk: there the mean square distance is half of the squared radius.
    [[nodiscard]] double area() const;
  };
  [[nodiscard]] static Place place_of(std::span<const Reflected> light, std::uint32_t first, std::uint32_t last);
  // Splits the light of a place at the mean of the axis of largest extent, so that separate clusters are separated. Returns the first
  // index of the second part; neither part is empty.
  [[nodiscard]] static std::uint32_t cut(std::span<Reflected> light, const Place& place);
  // The light of those cells that are far brighter than the rest.
  [[nodiscard]] static std::vector<Reflected> bright_light(std::vector<Reflected> light, double area);
  // Photons that the places send on, each with its place as source.
  [[nodiscard]] PhotonGrid sent_on(std::span<const Reflected> light, const Use& use, const MeetFront& meet) const;

  std::vector<Place> places_;
  PhotonGrid photons_;
  double share_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/bright_places.cpp>
#endif
