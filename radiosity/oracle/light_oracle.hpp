// SPDX-License-Identifier: MIT
#pragma once

// The second opinion of F-refinement where a light shines. A criterion of form factors alone knows nothing of shadow
// boundaries (paper 4.4) nor of what a strong small lamp does to a large wall. Emission is known before anything is
// solved; so a patch that a light may be linked to is split while the light varies too much across it:
//
//     E * RMS variation of F V over the patch * sqrt(area of the patch / area of the scene)  >  epsilon * mean emission
//
// times 2 rho on the left where a patch reflects less than half, because what errs is what it reflects: the patch's share of the relative
// L2 error where the reflected light is about as bright as the mean emission; where it is much darker, F-refinement hands in a smaller
// epsilon (Fineness). F varies as the disk estimate does between the corners and the point nearest to the light, with the normals tilted by
// the deviation of the patch from a curved object (linear between extremes: RMS = difference / sqrt 12); near a lamp that is long and
// narrow it varies as F by the lamp's outline does. V is all or nothing at a point: RMS = sqrt(V (1 - V)). Of a cluster F is what the light
// shows to the places in it, from the nearest to the farthest; how its faces are turned does not matter, because each applies its own
// cosine. Where one picture is what counts, the area of a patch counts as often as the picture asks (importance.hpp).

#include <cstdint>
#include <optional>
#include <vector>

#include <raycast/shaft.hpp>

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
  // The references must outlive the oracle; the hierarchy holds clusters and input faces when it is made, and may grow. `buried`, by node:
  // input faces that are not part of the scene's area (buried.hpp); none when it is empty.
  LightOracle(const Scene& input, const SceneView& scene, const ShownAreas& shown, double epsilon, std::uint64_t seed,
              const std::vector<bool>& buried = {});

  // Of the faces over which light is spread (lit_faces.hpp).
  [[nodiscard]] double scene_area() const { return scene_area_; }

  // Asked once it is known what can stand between the two. Splits the end whose light varies too much because of the other, down to
  // min_area. A leaf of at most that area is split where F varies by more than sqrt(min_area / area) times as much, at least four times:
  // beside a bright lamp the light changes within a hand's breadth, and such places are few. What is split already needs no new leaves, so
  // a link goes down to its children as it would above min_area.
  [[nodiscard]] Decision operator()(const Question& question) const {
    const std::uint32_t split = wants_split(question);
    if (split == no_node) { return Decision::link; }
    return split == question.p ? Decision::split_p : Decision::split_q;
  }

 private:
  // The end of the pair that should be split because of the light of the other, or no_node. Adds its segments to the question's rays.
  [[nodiscard]] std::uint32_t wants_split(const Question& question) const;
  [[nodiscard]] double emission(const Node& node) const {
    return node.is_cluster() ? of_cluster_[node.cluster].mean : emission_[node.surface];
  }

  // Of a patch and a cluster of lamps; as of two patches.
  [[nodiscard]] bool varies_by_lamp(std::uint32_t receiver, std::uint32_t lamp, double weight, double tolerance, RayCount& rays) const;
  [[nodiscard]] std::uint32_t wants_cluster_split(std::uint32_t receiver, std::uint32_t source, double weight, RayCount& rays) const;

  SceneView scene_;
  const ShownAreas* shown_;
  ClusterSampler sampler_;
  std::optional<LampExchange> lamps_;  // where lamps alone have clusters
  double epsilon_;
  std::uint64_t seed_;
  std::vector<double> emission_;   // one an input surface: the largest channel, relative to the mean
  std::vector<double> shows_;      // one an input surface: how much it shows of the light that arrives, beside one that reflects half
  std::vector<double> lamp_area_;  // one an input surface: of all that shines like it and is of the same body; 0 in a room
  struct ClusterLight {
    double mean = 0.0, brightest = 0.0;  // of its faces
  };
  std::vector<ClusterLight> of_cluster_;
  double scene_area_ = 0.0;
};
static_assert(Oracle<LightOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/light_oracle.cpp>
#endif
