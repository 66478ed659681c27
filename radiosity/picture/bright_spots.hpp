// SPDX-License-Identifier: MIT
#pragma once

// Small surfaces that reflect far more light than others do: the ceiling above a lamp, a sill in the sun, the inside of a housing. Of the
// rays that a point sends out evenly a few meet such a spot, or none does, so what they say of its light is noise: blotches in a picture.
// Here a point can choose points of the spots instead, by the light that it may get from them, and tell how likely a choice was; both ways
// are then combined by the balance heuristic (Veach and Guibas 1995).
//
// The spots are triangles of the solution's mesh, in groups. From a point each group is as likely as the light that it sends there, by the
// photons that landed around the point (spot_photons.hpp); a small part goes by what it would send though nothing stood between, for where
// photons are few. Each triangle of a group is chosen by its power, each point of a triangle alike.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/met.hpp>
#include <radiosity/picture/spot_photons.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

class BrightSpots {
 public:
  // None.
  BrightSpots() = default;
  // Of what a solution shows, but for `apart`: by input surface, light that is found in other ways. `lookup` must outlive this.
  BrightSpots(const Lookup& lookup, const DirectLight& direct, std::span<const Color> apart);

  [[nodiscard]] bool empty() const { return groups_.empty(); }

  struct Target {
    raycast::SurfacePoint point;
    std::uint32_t object = 0, sheet = 0;
  };

  // Has a ray from here that was aimed at a target met it? Where meshes stand in for its object (direct_light.hpp) these are met, a little
  // beside it.
  [[nodiscard]] static bool reached(const DirectLight& direct, const Target& target, const glm::dvec3& from, const Met& met);

  // What a point of a surface sees of them.
  class From {
   public:
    From(const BrightSpots& spots, const raycast::SurfacePoint& point) : From{spots, point.position, &point.normal} {}
    // The same of points near this one, whichever way they face.
    From(const BrightSpots& spots, const glm::dvec3& position) : From{spots, position, nullptr} {}
    // The root mean square of what even rays find of the spots, in this light, the irradiance at the point (sum of channels, W/m2). Where
    // many of them meet spots it is that of the border alone, for rays lie evenly. Over the root of their number it is the error that the
    // spots leave.
    [[nodiscard]] double contrast(double light) const;
    // Does a single even ray spread more by the spots than this light? So it is with paths, which meet each spot by chance alone.
    [[nodiscard]] bool spread_more_than(double light) const { return square_ > light * light; }
    // A point of the spots, by numbers in (0, 1).
    [[nodiscard]] Target choose(const std::array<double, 4>& numbers) const;
    // The probability by area with which that chooses points of this triangle of an input surface; 0 where it is no spot.
    [[nodiscard]] double density(std::uint32_t surface, std::uint32_t triangle) const;
    // The probability with which that chooses a place that was met from `here`, in that of an even ray from there.
    [[nodiscard]] double aimed(std::uint32_t surface, const Lookup::Found& found, const raycast::SurfacePoint& here,
                               const raycast::SurfacePoint& there) const;

   private:
    From(const BrightSpots& spots, const glm::dvec3& position, const glm::dvec3* normal);
    // By group, what it would send here though nothing stood between, W/m2; and their sum.
    [[nodiscard]] double unhidden(const glm::dvec3& position, const glm::dvec3* normal, std::vector<double>& light) const;

    const BrightSpots* spots_;
    std::vector<double> until_;  // by group: the probability of it and of those before it
    double square_ = 0.0;        // mean square of what even rays find of the spots
    double border_ = 0.0;        // what is left of it where rays lie so evenly that borders of spots alone count
  };

 private:
  struct Spot {
    std::uint32_t object = 0, sheet = 0, triangle = 0;
    std::uint32_t group = 0;
    glm::dvec3 middle{0.0}, normal{0.0};
    double area = 0.0, power = 0.0;  // of the true surface; the power is the sum of its channels
    double until = 0.0;              // power of it and of those of its group that stand before it
  };
  struct Group {
    std::uint32_t first = 0, last = 0;    // spots
    glm::dvec3 middle{0.0}, normal{0.0};  // means by power; the normal is shorter than 1 where theirs differ
    double radius = 0.0, power = 0.0;     // RMS distance from the middle
    double radiosity = 0.0;               // mean by power, sum of channels
  };
  // Cuts the group whose light differs most from one of its spots to the next in two, until groups are many.
  void make_groups();
  // Sorts the spots of a group where they differ most, by place or by normal. Returns the first of the second part.
  [[nodiscard]] std::uint32_t cut(const Group& group);
  [[nodiscard]] Group group_of(std::uint32_t first, std::uint32_t last) const;
  // A group by a number in (0, 1), where `until` has the probability of each and those before it; the number within its range.
  struct Chosen {
    std::size_t group = 0;
    double rest = 0.0;
  };
  [[nodiscard]] static Chosen group_at(std::span<const double> until, double number);
  // A spot of a group by power.
  [[nodiscard]] const Spot& spot_at(const Group& group, double number) const;
  // A point of a spot's triangle, by two numbers in (0, 1): all are as likely.
  [[nodiscard]] Target point_of(const Spot& spot, double u, double v) const;
  struct Photons {
    std::vector<std::uint32_t> sent, elsewhere;  // by group; of these, how many landed on what is no spot
    std::vector<SpotPhotons::Photon> landed;
  };
  // Sends out photons until enough have landed on what is no spot.
  void send_photons(const DirectLight& direct);
  // Sends sixteen, from number `first` on; `until`: by group, the probability of it and of those before it.
  void send16(const DirectLight& direct, std::uint32_t first, const std::vector<double>& until, Photons& photons) const;

  const Lookup* lookup_ = nullptr;
  std::vector<Spot> spots_;  // by group
  std::vector<Group> groups_;
  std::vector<std::vector<std::uint32_t>> spot_of_;  // by input surface and triangle: number of the spot, or none
  SpotPhotons photons_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/bright_spots.cpp>
#endif
