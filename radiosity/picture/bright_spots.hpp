// SPDX-License-Identifier: MIT
#pragma once

// Small surfaces that reflect far more light than others: the ceiling above a lamp, a sill in the sun, the inside of a housing. Of the
// rays that a point sends out uniformly, only a few or none meet such a spot, so their estimate of its light is noisy and causes blotches
// in a picture. This class lets a point choose points of the spots instead, by the light that it may receive from them, and provides the
// probability of each choice; both sampling methods are combined by the balance heuristic (Veach and Guibas 1995).
//
// The spots are triangles of the solution's mesh, in groups. A group is chosen with a probability proportional to the light that it sends
// to the point, estimated from the photons that landed around the point (spot_photons.hpp); a small part of the probability follows the
// unoccluded light, for places with few photons. Within a group a triangle is chosen by its power, and a point uniformly within the
// triangle.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
  // No spots.
  BrightSpots() = default;
  // Finds the spots in what a solution shows, minus `apart`: by input surface, light that is found in other ways. `lookup` must outlive
  // this.
  BrightSpots(const Lookup& lookup, const DirectLight& direct, std::span<const Color> apart);

  [[nodiscard]] bool empty() const { return groups_.empty(); }

  // A chosen point of a spot, and the weights of the corners of its triangle there.
  struct Target {
    raycast::ScenePoint at;
    std::uint32_t spot = 0;
    glm::dvec3 weight{0.0};
  };
  // What the lookup finds at the target. On a flat object its triangle is known, so nothing is searched.
  [[nodiscard]] std::optional<Lookup::Found> found(const Target& target) const;

  // Has a ray from `from`, aimed at a target, met it? If meshes stand in for the target's object (direct_light.hpp), the hit may be
  // slightly off the target.
  [[nodiscard]] static bool reached(const DirectLight& direct, const raycast::ScenePoint& target, const glm::dvec3& from,
                                    const raycast::ScenePoint& met);

  // The distribution of the spots' light as seen from a point of a surface.
  class From {
   public:
    From(const BrightSpots& spots, const raycast::SurfacePoint& point) : From{spots, point.position, &point.normal} {}
    // The same for points near this one, with any normal.
    From(const BrightSpots& spots, const glm::dvec3& position) : From{spots, position, nullptr} {}
    // RMS of the contribution of the spots to a single uniform ray, relative to `light`, the irradiance at the point (sum of channels,
    // W/m2). If many rays meet spots, only the contribution of the spots' borders counts, because the rays are stratified. Divided by the
    // square root of the number of rays, it is the relative error caused by the spots.
    [[nodiscard]] double contrast(double light) const;
    // Does the contribution of the spots to a single ray have an RMS above `light`? Used for paths, which are not stratified over the
    // spots.
    [[nodiscard]] bool spread_more_than(double light) const { return square_ > light * light; }
    // Chooses a point of the spots, by numbers in (0, 1).
    [[nodiscard]] Target choose(const std::array<double, 4>& numbers) const;
    [[nodiscard]] std::optional<Lookup::Found> found(const Target& target) const { return spots_->found(target); }
    // Probability density by area with which choose() picks points of this triangle of an input surface; 0 if it is no spot.
    [[nodiscard]] double density(std::uint32_t surface, std::uint32_t triangle) const;
    // The density with which choose() picks a place `there` seen from `here`, relative to that of a uniform ray.
    [[nodiscard]] double aimed(std::uint32_t surface, const Lookup::Found& found, const raycast::SurfacePoint& here,
                               const raycast::SurfacePoint& there) const;

   private:
    From(const BrightSpots& spots, const glm::dvec3& position, const glm::dvec3* normal);
    // Computes the unoccluded light of each group at this point, W/m2; returns the sum.
    [[nodiscard]] double unhidden(const glm::dvec3& position, const glm::dvec3* normal, std::vector<double>& light) const;

    const BrightSpots* spots_;
    std::vector<double> until_;  // by group: cumulative probability
    double square_ = 0.0;        // mean square of the spots' contribution to a uniform ray
    double border_ = 0.0;        // the part of it that remains with stratified rays: that of the spots' borders
  };

 private:
  struct Spot {
    std::uint32_t object = 0, sheet = 0, triangle = 0;
    std::uint32_t group = 0;
    glm::dvec3 middle{0.0}, normal{0.0};
    double area = 0.0, power = 0.0;  // area of the true surface; power is the sum of the channels
    double until = 0.0;              // cumulative power within its group, up to and including it
  };
  struct Group {
    std::uint32_t first = 0, last = 0;    // range of its spots
    glm::dvec3 middle{0.0}, normal{0.0};  // means weighted by power; the normal is shorter than 1 if the normals differ
    double radius = 0.0, power = 0.0;     // radius: RMS distance from the middle
    double radiosity = 0.0;               // mean weighted by power, sum of the channels
  };
  // Repeatedly splits the group whose light varies most between its spots, until there are enough groups.
  void make_groups();
  // Partitions the spots of a group along the axis of largest variation, of position or normal. Returns the first spot of the second part.
  [[nodiscard]] std::uint32_t cut(const Group& group);
  [[nodiscard]] Group group_of(std::uint32_t first, std::uint32_t last) const;
  // A group chosen by a number in (0, 1), given the cumulative probabilities `until`; `rest`: the position of the number within the
  // group's interval.
  struct Chosen {
    std::size_t group = 0;
    double rest = 0.0;
  };
  [[nodiscard]] static Chosen group_at(std::span<const double> until, double number);
  // Chooses a spot of a group by power: its index.
  [[nodiscard]] std::uint32_t spot_at(const Group& group, double number) const;
  // A point uniformly distributed on a spot's triangle, by two numbers in (0, 1).
  [[nodiscard]] Target point_of(std::uint32_t spot, double u, double v) const;
  struct Photons {
    std::vector<std::uint32_t> sent, elsewhere;  // by group: photons sent, and how many of them landed outside the spots
    std::vector<SpotPhotons::Photon> landed;
  };
  // Sends photons until enough have landed outside the spots.
  void send_photons(const DirectLight& direct);
  // Sends sixteen photons, beginning with number `first`; `until`: cumulative probability of the groups.
  void send16(const DirectLight& direct, std::uint32_t first, const std::vector<double>& until, Photons& photons) const;

  const Lookup* lookup_ = nullptr;
  std::vector<Spot> spots_;                         // sorted by group
  std::vector<double> until_;                       // by spot: Spot::until, packed for the search
  std::vector<std::array<glm::dvec3, 3>> corners_;  // by spot: of its triangle
  std::vector<Group> groups_;
  std::vector<std::vector<std::uint32_t>> spot_of_;  // by input surface and triangle: index of the spot, or none
  SpotPhotons photons_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/bright_spots.cpp>
#endif
