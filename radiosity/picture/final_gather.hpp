// SPDX-License-Identifier: MIT
#pragma once

// Light at a point of the true surface, better than the mesh of the solution has it: direct light by itself (radiosity/direct), indirect
// light by one more gathering of the solution, along rays (Reichert 1992; final gather). So the mesh is only looked at from afar, where
// what it smears over a leaf is averaged out; edges of shadows and what lies in a corner do not depend on the size of its leaves.
//
// What shines and is no lamp of DirectLight is found by the rays. Where small spots are much brighter than all else, some rays are aimed at
// these (bright_spots.hpp).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/bright_spots.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/met.hpp>
#include <radiosity/picture/near_light.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

class FinalGather {
 public:
  // `mesh` is a solution of the scene, in the scene's coordinates; `frame` that of the solution. All inputs may go after this.
  FinalGather(const Scene& scene, const Mesh& mesh, const Frame& frame);
  FinalGather(const FinalGather&) = delete;
  FinalGather& operator=(const FinalGather&) = delete;

  [[nodiscard]] const raycast::Scene& objects() const { return lookup_.objects(); }
  [[nodiscard]] const Frame& frame() const { return lookup_.frame(); }
  [[nodiscard]] const DirectLight& direct() const { return direct_; }
  [[nodiscard]] const Material& material(std::uint32_t surface) const { return materials_[surface]; }  // of an input surface

  // A point that is seen, in the frame.
  struct Place {
    raycast::SurfacePoint point;
    std::uint32_t object = 0, surface = 0;
  };
  // The point from which one looks. If it lies in the air, the first front that a ray meets cannot be buried, so that is not checked.
  struct Eye {
    glm::dvec3 position{0.0};  // in the frame
    bool in_air = false;
  };
  [[nodiscard]] Eye eye(const glm::dvec3& in_scene) const;
  // What is seen in up to sixteen directions: the first surface that shows its front and is not buried; backs are looked through
  // (lookup.hpp). `outlines`: where those are as they are, not as those of meshes that stand in for slow objects.
  [[nodiscard]] std::array<std::optional<Place>, 16> seen16(const Eye& eye, std::span<const glm::dvec3> directions, bool outlines) const;

  // What the mesh of the solution shows at a place, W/m2; nothing where it has no face.
  [[nodiscard]] std::optional<Color> solved(const Place& place) const {
    return lookup_.at(place.object, place.surface - lookup_.surface(place.object, 0), place.point);
  }

  // The point of the same sheet that is seen from the eye beside a place, in a direction (of any length) that differs by part of a pixel;
  // nothing where the sheet bends away.
  [[nodiscard]] std::optional<Place> beside(const Place& place, const glm::dvec3& eye, const glm::dvec3& direction) const;

  // Of points of one surface: their direct light. The gather must outlive it.
  [[nodiscard]] LitRegion lit_region(std::span<const Place> places) const;

  // Does nothing shine but lamps, nor reflect? Then there is no indirect light.
  [[nodiscard]] bool direct_alone() const { return direct_alone_; }

  struct Indirect {
    Color irradiance{0.0};               // W/m2
    double variance = 0.0;               // of the sum of its channels, by the spread of its rays
    double nearness = 0.0;               // 1 / harmonic mean distance of what is seen, in the frame
    double nearness_of_light = 0.0;      // the same with each distance weighted by the light from there
    double nearest = raycast::infinity;  // the distance within which some few of the rays end
  };
  // Light that comes to a point by reflection, or from what is no lamp: by `least` rays, a positive multiple of 64, or as many more, up to
  // `most`, as it takes for the standard error to fall to this share of the light; what the mesh is too coarse for adds one of about this
  // share of all light there by at most so many paths (near_light.hpp). `key` names the point: it fixes the rays.
  [[nodiscard]] Indirect indirect(const Place& place, std::uint32_t least, std::uint32_t most, double error, std::uint64_t key,
                                  std::uint32_t most_paths = 256) const;

 private:
  [[nodiscard]] Met met(const raycast::Hit& hit, const raycast::Segment& ray) const { return radiosity::met(objects(), direct_, hit, ray); }

  // The rays of a point.
  struct Sender {
    const Place& place;
    glm::dvec3 from{0.0};
    std::uint32_t owner = raycast::no_object, sheet = 0;
    BrightSpots::From spots;
    std::uint32_t aimed = 0;  // so many times sixteen of its rays go to the spots, after every 64 even ones
  };
  // What rays found, in the unit of an even one.
  struct Sum {
    Color light{0.0};
    std::array<double, 4> part{};           // of the rays, by fours of sixteen: their spread is the standard error
    double nearness = 0.0, of_light = 0.0;  // sums of 1 / distance: of the rays, and by the light that they bring
    std::vector<double> distances;          // of even rays
    std::uint32_t spots_met = 0;            // by aimed rays
    std::vector<NearLight::Seen> near;      // what even rays found that is not so sure (near_light.hpp)
    void add(std::size_t p, const Color& more, double distance) {
      light += more;
      part[p] += more.x + more.y + more.z;
      of_light += (more.x + more.y + more.z) / distance;
    }
  };
  // The light that comes along a ray, and how many aimed rays are to be expected in its direction for an even one.
  struct Arriving {
    Color light{0.0};
    double aimed = 0.0;
    double coarse_within = 0.0;  // seen from nearer than this, it may be wrong
  };
  [[nodiscard]] Arriving arriving(const Sender& sender, const Met& found) const;
  // Sixteen rays each, from number `first` of the sequence on.
  void cast_evenly(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const;
  // What is near is left to even rays (mend_near).
  void cast_at_spots(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const;
  // Replaces the light of what is near by a better estimate where it matters; `all`: light that is known to arrive, sum of channels over
  // `rays` rays.
  // Returns the variance that this adds.
  [[nodiscard]] double mend_near(Sum& sum, const Place& place, double all, std::uint32_t rays, double most_paths, double error,
                                 std::uint64_t key) const;
  // Photons of the lamps, where these are several; their sources are lamps of the direct light.
  [[nodiscard]] PhotonGrid send_lamp_photons(const std::vector<Surface>& boundaries, std::vector<Color> emission) const;
  // The sum of the channels that the place reflects: the solution knows of no others there.
  [[nodiscard]] double of_reflected_channels(const Place& place, const Color& light) const;
  // That of the irradiance that the solution shows there, W/m2.
  [[nodiscard]] double irradiance_solved(const Place& place) const;

  Lookup lookup_;
  std::vector<Material> materials_;  // of the input surfaces
  DirectLight direct_;
  PhotonGrid lamp_photons_;
  BrightSpots spots_;
  NearLight near_;
  bool direct_alone_ = false;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/final_gather.cpp>
#endif
