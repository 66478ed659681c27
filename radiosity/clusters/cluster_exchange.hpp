// SPDX-License-Identifier: MIT
#pragma once

// The exchange of a link with a cluster at one or both ends, occlusion included. Pairs of points are drawn on the faces; a face is chosen
// with probability proportional to the projected area that it shows to the other end. Each pair contributes the kernel divided by its
// probability, so the mean is an unbiased estimate of A_p F_pq over the faces that face each other. Faces of the same cluster that hide
// each other block rays like any other object.
//
// Between a face f of p and a face g of q, the link then stands for G w_f w_g, where w_f is the share of f in the area that p shows
// towards q (direction_lattice.hpp), A_f shown_f / sum. The same weights distribute the received light and collect the sent light
// (transport.hpp).

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// One end of a cluster link: a cluster or a patch.
struct ClusterEnd {
  std::uint32_t node = no_node;
  Aim towards;         // the other end
  double shown = 0.0;  // projected area in that direction, m2; for a patch, its area
};

struct ClusterExchange {
  double exchange = 0.0;
  double fraction = 1.0;  // share of the light that is not blocked
  double spread = 0.0;    // standard deviation of one sample of the exchange, relative to its mean
  std::uint64_t rays = 0;
};

class ClusterSampler {
 public:
  // The references must outlive the sampler; the hierarchy may grow. Without `exposure` all area counts as exposed.
  ClusterSampler(const SceneView& scene, const Exposure* exposure, const ShownAreas& shown)
      : scene_{scene}, exposure_{exposure}, shown_{&shown} {}

  // The end `node` of a link whose other end lies in `direction`, a vector of any length but 0.
  [[nodiscard]] ClusterEnd end(std::uint32_t node, const glm::dvec3& direction) const;

  // Draws rounds of 16 pairs of points: a single round if all pairs are clear or all are blocked and their values vary little,
  // otherwise `rounds`.
  [[nodiscard]] ClusterExchange operator()(const ClusterEnd& p, const ClusterEnd& q, std::uint32_t rounds, Random random) const;

 private:
  struct Point {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    double per_shown = 1.0;  // area of its face divided by the projected area of the face
    std::uint32_t object = 0, sheet = 0;
  };
  // Upper bound of a sample's weight: a face that is nearly edge-on seen from the centre is drawn rarely and would count very much.
  static constexpr double most_weight = 4.0;

  [[nodiscard]] double area(std::size_t i) const { return exposure_ != nullptr ? exposure_->area[i] : scene_.hierarchy[i].area; }

  // Draws a point; `u`, uniform in [0, 1), chooses the face.
  [[nodiscard]] Point draw(const ClusterEnd& end, double u, Random& random) const;

  SceneView scene_;
  const Exposure* exposure_;
  const ShownAreas* shown_;
};

// Sets the exchange and the directions of a link with a cluster at one or both ends.
ClusterExchange evaluate_cluster_link(const ClusterSampler& sampler, const Hierarchy& hierarchy, Link& link, std::uint32_t rounds,
                                      Random random);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/clusters/cluster_exchange.cpp>
#endif
