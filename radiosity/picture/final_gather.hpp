// SPDX-License-Identifier: MIT
#pragma once

// Computes the light at a point of the true surface more accurately than the solution's mesh: direct light separately (radiosity/direct),
// indirect light by one more gathering of the solution along rays (final gather; Reichert 1992). The mesh is looked up only from a
// distance, where its error within a leaf averages out, so shadow edges and the light in corners do not depend on the size of the leaves.
//
// Emitters that are not lamps of DirectLight are found by the rays. If small spots are much brighter than everything else, some rays are
// aimed at them (bright_spots.hpp).

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
#include <radiosity/picture/gathered_point.hpp>
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
  // `mesh`: a solution of the scene, in scene coordinates; `frame`: that of the solution. All inputs may be destroyed after this.
  FinalGather(const Scene& scene, const Mesh& mesh, const Frame& frame);
  FinalGather(const FinalGather&) = delete;
  FinalGather& operator=(const FinalGather&) = delete;

  [[nodiscard]] const raycast::Scene& objects() const { return lookup_.objects(); }
  [[nodiscard]] const Frame& frame() const { return lookup_.frame(); }
  [[nodiscard]] const DirectLight& direct() const { return direct_; }
  [[nodiscard]] const Material& material(std::uint32_t surface) const { return materials_[surface]; }  // of an input surface

  // A visible point, in the frame.
  struct Place {
    raycast::SurfacePoint point;
    std::uint32_t object = 0, surface = 0;
  };
  // The point from which one looks. If it lies in air, the first front face on a ray cannot be buried, so that is not checked.
  struct Eye {
    glm::dvec3 position{0.0};  // in the frame
    bool in_air = false;
  };
  [[nodiscard]] Eye eye(const glm::dvec3& in_scene) const;
  // The surfaces seen in up to sixteen directions: the first one on each ray that shows its front and is not buried; back faces are
  // looked through (lookup.hpp). `outlines`: with the exact outlines, not those of meshes that stand in for slow objects.
  [[nodiscard]] std::array<std::optional<Place>, 16> seen16(const Eye& eye, std::span<const glm::dvec3> directions, bool outlines) const;

  // The radiosity of the solution's mesh at a place, W/m2; nothing if it has no face there.
  [[nodiscard]] std::optional<Color> solved(const Place& place) const {
    return lookup_.at({place.point, place.object, place.surface - lookup_.surface(place.object, 0)});
  }

  // The point of the same sheet that is seen from the eye in a slightly different direction, by a part of a pixel; nothing if the sheet
  // bends away. `direction` may have any length.
  [[nodiscard]] std::optional<Place> beside(const Place& place, const glm::dvec3& eye, const glm::dvec3& direction) const;

  // For computing direct light at these points of one surface. The gather must outlive it.
  [[nodiscard]] LitRegion lit_region(std::span<const Place> places) const;

  // Is there no indirect light, because nothing but lamps emits, and nothing reflects?
  [[nodiscard]] bool direct_alone() const { return direct_alone_; }

  struct Indirect {
    Color irradiance{0.0};               // W/m2
    double variance = 0.0;               // of the sum of its channels, estimated from the spread of the rays
    double nearness = 0.0;               // 1 / harmonic mean distance of the hits, in the frame
    double nearness_of_light = 0.0;      // as above, with distances weighted by the light from there
    double nearest = raycast::infinity;  // distance within which a small share of the rays ends
  };
  // Irradiance by reflection or from emitters that are not lamps. Casts `least` rays, a positive multiple of 64, and continues up to
  // `most` until the standard error is at most the share `error` of the light. Light from nearby triangles too coarse for it is replaced
  // by an estimate from at most `most_paths` paths, with an additional error of about the same share of all light (near_light.hpp). `key`
  // names the point and determines the rays.
  [[nodiscard]] Indirect indirect(const Place& place, const GatherRays& effort, std::uint64_t key) const;

 private:
  [[nodiscard]] raycast::ScenePoint met(const raycast::Hit& hit, const raycast::Segment& ray) const {
    return radiosity::met(objects(), direct_, hit, ray);
  }

  // The origin of a point's rays, and how many are aimed.
  struct Sender {
    const Place& place;
    glm::dvec3 from{0.0};
    std::uint32_t owner = raycast::no_object, sheet = 0;
    BrightSpots::From spots;
    std::uint32_t aimed = 0;  // sixteen times this many rays are aimed at spots after every 64 uniform ones
  };
  // What the rays found; the weight of a uniform ray is 1.
  struct Sum {
    Color light{0.0};
    std::array<double, 4> part{};           // in four groups of rays, whose spread gives the standard error
    double nearness = 0.0, of_light = 0.0;  // sums of 1 / distance over the rays, plain and weighted by light
    std::vector<double> distances;          // of uniform rays
    std::uint32_t spots_met = 0;            // by aimed rays
    std::vector<NearLight::Seen> near;      // hits of uniform rays where the solution is uncertain (near_light.hpp)
    void add(std::size_t p, const Color& more, double distance) {
      light += more;
      part[p] += sum_of_channels(more);
      of_light += sum_of_channels(more) / distance;
    }
  };
  // The light along a ray, and the expected number of aimed rays in its direction per uniform ray.
  struct Arriving {
    Color light{0.0};
    double aimed = 0.0;
    double coarse_within = 0.0;  // seen from nearer than this, the light may be wrong
  };
  // `target`: the target of an aimed ray, if the place is one.
  [[nodiscard]] Arriving arriving(const Sender& sender, const raycast::ScenePoint& found,
                                  const BrightSpots::Target* target = nullptr) const;
  // Cast sixteen rays, beginning with number `first` of the sequence.
  void cast_evenly(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const;
  // Ignores near hits, which are left to uniform rays (mend_near).
  void cast_at_spots(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const;
  // Replaces the light of near hits by a better estimate where it matters. `all`: light known to arrive, sum of channels over `rays`
  // rays. Returns the variance that the estimate adds.
  [[nodiscard]] double mend_near(Sum& sum, const Place& place, double all, std::uint32_t rays, const GatherRays& effort,
                                 std::uint64_t key) const;
  // Photons of the lamps, if there are several; their sources are indices of the direct light's lamps.
  [[nodiscard]] PhotonGrid send_lamp_photons(const std::vector<Surface>& boundaries, std::vector<Color> emission) const;
  // The sum of those channels that the surface reflects; the solution knows only these.
  [[nodiscard]] double of_reflected_channels(const Place& place, const Color& light) const;
  // The same for the irradiance of the solution, W/m2.
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
