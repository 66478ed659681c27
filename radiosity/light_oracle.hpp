// SPDX-License-Identifier: MIT
#pragma once

// The second opinion of F-refinement where a light shines. A criterion of form factors alone knows nothing of shadow
// boundaries (paper 4.4) nor of what a strong small lamp does to a large wall. Emission is known before anything is
// solved; so a patch that a light may be linked to is split while the light varies too much across it:
//
//     E * RMS variation of F V over the patch * sqrt(area of the patch / area of the scene)  >  share * epsilon * mean emission
//
// the patch's share of the relative L2 error, dimensionless. F varies as the disk estimate does between the corners and the
// point nearest to the light
// (linear between extremes: RMS = difference / sqrt 12); V is all or nothing at a point: RMS = sqrt(V (1 - V)).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/form_factor.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/occlusion.hpp>
#include <radiosity/oracle.hpp>
#include <radiosity/patch.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/random.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/visibility.hpp>

namespace radiosity {

class LightOracle {
 public:
  // The references must outlive the oracle; the hierarchy holds the roots when it is made, and may grow.
  LightOracle(const Scene& scene, const raycast::Scene& objects, const Plan& plan, const Patches& patches, const Hierarchy& hierarchy,
              double epsilon, std::uint64_t seed)
      : objects_{&objects}, plan_{&plan}, patches_{&patches}, hierarchy_{&hierarchy}, epsilon_{share * epsilon}, seed_{seed} {
    for (const InputSurface& input : radiosity::surfaces(scene)) {
      const Color& emission = scene.materials[input.material].emission;
      emission_.push_back(std::max({emission.x, emission.y, emission.z}));
    }
    double power = 0.0;
    for (const Node& root : hierarchy) {
      if (root.parent != no_node) { continue; }
      power += root.area * emission_[root.surface];
      scene_area_ += root.area;
    }
    for (double& e : emission_) { e = power > 0.0 ? e / power * scene_area_ : 0.0; }
  }

  // Total area of the roots.
  [[nodiscard]] double scene_area() const { return scene_area_; }

  // The end of the pair that should be split because of the light of the other, or no_node. Adds its segments to `rays`.
  // `list` is that of the pair.
  [[nodiscard]] std::uint32_t wants_split(std::uint32_t p, std::uint32_t q, const raycast::OccluderList& list, RayCount& rays) const {
    const Hierarchy& nodes = *hierarchy_;
    const bool q_shines = emission_[nodes[q].surface] >= emission_[nodes[p].surface];
    const std::uint32_t receiver = q_shines ? p : q;
    const Node& to = nodes[receiver];
    const Node& from = nodes[q_shines ? q : p];
    // A light that was split into k parts has k links here, whose variations add up to between sqrt k and k of one.
    std::uint32_t root = q_shines ? q : p;
    while (nodes[root].parent != no_node) { root = nodes[root].parent; }
    const double parts = nodes[root].area / from.area;
    const double weight = emission_[from.surface] * std::sqrt(parts * to.area / scene_area_);
    if (!(weight > epsilon_)) { return no_node; }

    const Patch& patch = (*patches_)[receiver];
    double low = 1.0;
    double high = 0.0;
    const auto look = [&](const glm::dvec3& x) {
      const double f = disk_estimate(x, to.normal, from.centre, from.normal, from.area);
      low = std::min(low, f);
      high = std::max(high, f);
    };
    for (const glm::dvec3& x : patch.contour) { look(x); }
    look(nearest_point(to, from.centre));
    if (weight * (high - low) > std::sqrt(12.0) * epsilon_) { return receiver; }
    if (!(weight * high * 0.5 > epsilon_)) { return no_node; }  // sqrt(V (1 - V)) is at most one half

    const Patch& light = (*patches_)[q_shines ? q : p];
    const VisibilityEstimate seen = visibility(*objects_, *plan_, list, {&patch, to.object}, {&light, from.object}, 1,
                                               Random{seed_, (std::uint64_t{p} << 32) | q, 0x736861646f77ull});
    rays += seen.rays;
    const double mean = 0.5 * (low + high);
    return weight * mean * std::sqrt(seen.fraction * (1.0 - seen.fraction)) > epsilon_ ? receiver : no_node;
  }

 private:
  // Most of the L2 error comes from the lights. Measured on the reference scenes, a quarter halves the error of share = 1 for
  // 15 to 30 % more time; less brings little.
  static constexpr double share = 0.25;

  const raycast::Scene* objects_;
  const Plan* plan_;
  const Patches* patches_;
  const Hierarchy* hierarchy_;
  double epsilon_;
  std::uint64_t seed_;
  std::vector<double> emission_;  // one an input surface: the largest channel, relative to the mean over the scene's area
  double scene_area_ = 0.0;
};

}  // namespace radiosity
