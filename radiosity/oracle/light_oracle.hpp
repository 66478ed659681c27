// SPDX-License-Identifier: MIT
#pragma once

// The second criterion of F-refinement, for light from lamps. A criterion of form factors alone does not see shadow boundaries
// (paper 4.4) or the effect of a small strong lamp on a large wall. Emission is known before anything is solved, so a patch is
// split as long as the light of a lamp to which it may be linked varies too much across it:
//
//     E * RMS variation of F V over the patch * sqrt(area of the patch / area of the scene)  >  epsilon * mean emission
//
// with the left side multiplied by 2 rho for a patch with reflectance below one half, because only reflected light has an error. The left
// side is the patch's share of the relative L2 error if the reflected light is about as bright as the mean emission; if it is much
// darker, F-refinement passes a smaller epsilon (Fineness). F varies like the disk estimate between the corners and the point nearest to
// the lamp, with the normals tilted by the deviation of a curved patch (linear between extremes: RMS = difference / sqrt 12); near a long
// narrow lamp F is computed from the lamp's outline. V is 0 or 1 at a point: RMS = sqrt(V (1 - V)). For a cluster, F is that of the lamp
// to the nearest and farthest places in it; the orientation of its faces does not matter, because each applies its own cosine. If a
// single picture counts, areas are weighted by importance (importance.hpp).

#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/clusters/lamp_exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

class LightOracle {
 public:
  // The references must outlive the oracle. At construction the hierarchy holds only clusters and input faces; it may grow afterwards.
  // `buried`: by node, input faces that do not count to the scene's area (buried.hpp); may be empty.
  LightOracle(const Scene& input, const SceneView& scene, const ShownAreas& shown, double epsilon, std::uint64_t seed,
              const std::vector<bool>& buried = {});

  // Weighted area of the faces over which light is spread (lit_faces.hpp).
  [[nodiscard]] double scene_area() const { return scene_area_; }

  // To be asked once the possible blockers between the two nodes are known. Splits the end over which the other's light varies too much,
  // down to min_area. A leaf of at most that area is split only if F varies sqrt(min_area / area) times as much, at least four times:
  // beside a bright lamp the light changes over short distances, and such places are few. Splitting a node that already has children
  // makes no new leaves, so there the usual threshold applies.
  [[nodiscard]] Decision operator()(const Question& question) const {
    const std::uint32_t split = wants_split(question);
    if (split == no_node) { return Decision::link; }
    return split == question.p ? Decision::split_p : Decision::split_q;
  }

 private:
  // The end of the pair that should be split because of the other's light, or no_node. Adds the segments cast to question.rays.
  [[nodiscard]] std::uint32_t wants_split(const Question& question) const;
  [[nodiscard]] double emission(const Node& node) const {
    return node.is_cluster() ? of_cluster_[node.cluster].mean : emission_[node.surface];
  }

  // For a patch and a cluster of lamps, as for two patches.
  [[nodiscard]] bool varies_by_lamp(std::uint32_t receiver, std::uint32_t lamp, double weight, double tolerance, RayCount& rays) const;
  [[nodiscard]] std::uint32_t wants_cluster_split(std::uint32_t receiver, std::uint32_t source, double weight, RayCount& rays) const;

  SceneView scene_;
  const ShownAreas* shown_;
  ClusterSampler sampler_;
  std::optional<LampExchange> lamps_;  // set if only lamps have clusters
  double epsilon_;
  std::uint64_t seed_;
  std::vector<double> emission_;   // by input surface: largest channel, relative to the mean emission
  std::vector<double> shows_;      // by input surface: reflected light, relative to a surface of reflectance one half
  std::vector<double> lamp_area_;  // by input surface: area of the faces with equal emission on the same object; 0 in a room
  struct ClusterLight {
    double mean = 0.0, brightest = 0.0;  // mean and maximum over its faces
  };
  std::vector<ClusterLight> of_cluster_;
  double scene_area_ = 0.0;
};
static_assert(Oracle<LightOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/light_oracle.cpp>
#endif
