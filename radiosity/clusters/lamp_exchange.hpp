// SPDX-License-Identifier: MIT
#pragma once

// The light of a lamp of many faces on one patch: the exchange of a link between a cluster of faces that shine (make_lamp_clusters()) and a
// patch. Such a cluster is known by up to 256 points: of a few faces their Gauss points, of more their middles, of many faces so many of
// them, evenly over their area. What would arrive if nothing stood between is the sum over these points and the Gauss points of the patch,
// and so is the gradient over the patch; what does arrive is found by segments that start at the points by what each of them sends.
//
// As a cluster and a patch that are linked lie well apart (lamp_oracle.hpp), the sum is within some 1 % of the integral.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

class LampExchange {
 public:
  // Of the clusters that there are. The references must outlive this; the hierarchy may grow. Without `exposure` everything counts as
  // exposed.
  LampExchange(const SceneView& scene, const Exposure* exposure, const ShownAreas& shown);

  struct Result {
    double sent = 0.0;      // the exchange if nothing stood between
    glm::dvec3 slope{0.0};  // of that over the patch: relative change per length
    double linear = 0.0;    // RMS over the patch of the linear part, relative to the mean,
    double rest = 0.0;      // and of what the slope leaves
    double fraction = 1.0;  // of it that arrives
    RayCount rays;
  };
  // Rounds of 16 segments: one when all or none of them arrive, else `rounds`; with 0 rounds nothing is asked about what stands between.
  [[nodiscard]] Result operator()(std::uint32_t lamp, std::uint32_t patch, std::uint32_t rounds, Random random) const;

  // Sets the exchange and the shapes of a link between a cluster of lamps and a patch.
  Result evaluate(Link& link, std::uint32_t rounds, Random random) const;

 private:
  struct Point {
    glm::dvec3 position{0.0}, normal{0.0};
    double area = 0.0;
    std::uint32_t face = no_node;
  };
  static constexpr std::size_t most_points = 256;

  void add_points(const std::vector<std::uint32_t>& faces);
  [[nodiscard]] double area(std::size_t i) const { return exposure_ != nullptr ? exposure_->area[i] : scene_.hierarchy[i].area; }
  [[nodiscard]] std::span<const Point> points_of(std::uint32_t lamp) const;
  [[nodiscard]] PatchEnd end(std::uint32_t i) const;
  // The mean direction of the light from the lamp to a patch, to which it sends some.
  [[nodiscard]] glm::dvec3 way(std::uint32_t lamp, std::uint32_t patch) const;
  void see(Result& result, std::span<const Point> points, const std::vector<double>& until, std::uint32_t patch, std::uint32_t rounds,
           Random random) const;

  SceneView scene_;
  const Exposure* exposure_;
  const ShownAreas* shown_;
  std::vector<Point> points_;
  std::vector<std::size_t> first_;  // of each cluster, by its number
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/clusters/lamp_exchange.cpp>
#endif
