// SPDX-License-Identifier: MIT
#pragma once

// Small places that reflect much of a scene's light: the inside of a lamp's shade, the ceiling above a lamp, a table in a narrow beam. A
// path that goes on in a cosine-distributed direction meets such a place by chance, and then counts for all those that have missed it. So a
// part of the paths goes on towards one.
//
// Where these places are, photons of the lamps tell: where they land densely. Which of them light a point, photons tell that the places
// send on ("Importance driven path tracing using the photon map", Jensen 1995). All this only proposes directions: what a direction
// carries is found by the path, and each has a density(), by which light is neither lost nor counted twice (Veach and Guibas 1995). Nothing
// here knows of a solution.

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
    Landing from;
    double power = 0.0;  // sum of channels, in any unit
  };

  // None.
  BrightPlaces() = default;
  struct Use {
    double area = 0.0, diameter = 0.0;  // of the scene
    double share = 0.0;                 // of the directions that are to be aimed at the places
    std::uint32_t photons = 0;          // that they send on
  };
  // None where they would hold little of the light, or are not small.
  BrightPlaces(std::vector<Reflected> light, const Use& use, const MeetFront& meet);

  [[nodiscard]] bool empty() const { return places_.empty(); }

  // What From costs for one reflection, in microseconds of a core of 2024.
  [[nodiscard]] double work() const { return 0.03 * static_cast<double>(places_.size()); }

  static constexpr std::size_t most_places = 24;  // each is asked for every direction

  // Where a path may go on from a point of a surface: in a cosine-distributed direction, or, by the share, towards a place.
  class From {
   public:
    From(const BrightPlaces& places, const glm::dvec3& position, const glm::dvec3& normal);
    // A direction by numbers of its own; nothing where it would lead into the surface.
    template <class Numbers>
    [[nodiscard]] std::optional<glm::dvec3> direction(Numbers& random) const {
      const double choice = share_ > 0.0 ? random.uniform() : 1.0;
      const double u = random.uniform();
      return direction(choice, u, random.uniform());
    }
    // Per solid angle, of the unit direction w; over all of them it may sum to less than 1.
    [[nodiscard]] double density(const glm::dvec3& w) const;

   private:
    [[nodiscard]] std::optional<glm::dvec3> direction(double choice, double u, double v) const;

    // The cone around the sphere of a place. Left as it is where there is none: every path makes many of these.
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
    std::uint32_t first = 0, last = 0;  // of the light that made it
    double power = 0.0;
    glm::dvec3 centre{0.0};
    double radius = 0.0;   // of the sphere around all of it
    double squares = 0.0;  // mean square of its distance from the centre
    int axis = 0;          // in which it differs most: 0 to 2 x, y, z of the position, 3 to 5 of the normal

    // About the area on which it landed, as on a disk: the mean square of the distance is half of the squared radius there.
    [[nodiscard]] double area() const;
  };
  [[nodiscard]] static Place place_of(std::span<const Reflected> light, std::uint32_t first, std::uint32_t last);
  // Cuts the light of a place in two where it differs most, at its mean, so that what is apart comes apart. Returns the first of the second
  // part; neither is empty.
  [[nodiscard]] static std::uint32_t cut(std::span<Reflected> light, const Place& place);
  // The light of small cells that are far brighter than the rest.
  [[nodiscard]] static std::vector<Reflected> bright_light(std::vector<Reflected> light, double area);
  // Photons that the places send on, with the place that each comes from.
  [[nodiscard]] PhotonGrid sent_on(std::span<const Reflected> light, const Use& use, const MeetFront& meet) const;

  std::vector<Place> places_;
  PhotonGrid photons_;
  double share_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/bright_places.cpp>
#endif
