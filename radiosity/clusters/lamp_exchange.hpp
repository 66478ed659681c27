// SPDX-License-Identifier: MIT
#pragma once

// The exchange between a cluster of emitting faces (make_lamp_clusters()) and a patch, of which the patch gets the light of the faces when
// it is multiplied with their mean exitance: a face counts as its area times its exitance relative to that mean. The cluster is
// represented by up to 256 points: the Gauss points of few faces, the centres of more faces, or those of groups of faces if there are
// many. The unoccluded exchange, and its gradient over the patch, is the sum over these points and the Gauss points of the patch.
// Occlusion is sampled by segments whose start points are drawn in proportion to the light that each sends.
//
// A cluster and a patch that are linked lie well apart (lamp_oracle.hpp), so the sum is within some 1 % of the integral.

#include <cstddef>
#include <cstdint>
#include <functional>
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
  // For the clusters of the scene's hierarchy. The references must outlive this; the hierarchy may grow. Without `exposure` all area
  // counts as exposed. `emission`: of each input surface, in any unit.
  LampExchange(const SceneView& scene, const Exposure* exposure, const ShownAreas& shown, const std::vector<double>& emission);

  struct Result {
    double sent = 0.0;      // unoccluded exchange, m2
    glm::dvec3 slope{0.0};  // gradient of `sent` over the patch: relative change per length
    double linear = 0.0;    // RMS over the patch of the linear part, relative to the mean
    double rest = 0.0;      // RMS of the remainder, likewise
    double fraction = 1.0;  // share of `sent` that is not blocked
    RayCount rays;
  };
  // Casts rounds of 16 segments as visibility() does; with 0 rounds occlusion is not sampled.
  [[nodiscard]] Result operator()(std::uint32_t lamp, std::uint32_t patch, std::uint32_t rounds, Random random) const;

  // Sets the exchange and the shapes of a link between a cluster of lamps and a patch.
  Result evaluate(Link& link, std::uint32_t rounds, Random random) const;

 private:
  struct Point {
    glm::dvec3 position{0.0}, normal{0.0};
    double area = 0.0;  // times the relative exitance
    std::uint32_t face = no_node;
  };
  static constexpr std::size_t most_points = 256;

  void add_points(const std::vector<std::uint32_t>& faces, const std::vector<double>& emission);
  // `relative`: of a face, its exitance relative to the mean.
  void add_runs(const std::vector<std::uint32_t>& faces, const std::function<double(std::uint32_t)>& relative);
  [[nodiscard]] glm::dvec3 centroid(std::uint32_t i) const;
  [[nodiscard]] double area(std::size_t i) const { return exposure_ != nullptr ? exposure_->area[i] : scene_.hierarchy[i].area; }
  [[nodiscard]] std::span<const Point> points_of(std::uint32_t lamp) const;
  // The mean direction of the unoccluded light from the lamp to a patch, which must be lit by it.
  [[nodiscard]] glm::dvec3 way(std::uint32_t lamp, std::uint32_t patch) const;
  void see(Result& result, std::span<const Point> points, const std::vector<double>& until, std::uint32_t patch, std::uint32_t rounds,
           Random random) const;

  SceneView scene_;
  const Exposure* exposure_;
  const ShownAreas* shown_;
  std::vector<Point> points_;
  std::vector<std::size_t> first_;  // index of the first point of each cluster, by its number
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/clusters/lamp_exchange.cpp>
#endif
