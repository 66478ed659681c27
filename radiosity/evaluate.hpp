// SPDX-License-Identifier: MIT
#pragma once

// Puts the numbers into the links: form factor by contour, times the fraction that arrives (paper 4.3: this is done once
// the oracle has agreed, for it is the expensive part).

#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/exchange.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/links.hpp>
#include <radiosity/options.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/surface.hpp>
#include <radiosity/visibility.hpp>

namespace radiosity {

struct EvaluateResult {
  std::uint64_t rays = 0;
  std::uint64_t proven_clear = 0;  // links for which no segment was cast
  std::uint64_t blocked = 0;       // links removed because nothing arrives
  bool cancelled = false;
};

// What the exposed part of a patch exchanges with `other`, over what the whole patch would: its share of the area, unless the
// other's horizon cuts the patch. Then the object that buries the rest is often the one that draws the horizon (the wall of a
// post and the floor around it), and the share is that of the part above the horizon.
[[nodiscard]] inline double exposed_share(const raycast::Scene& scene, const PatchEnd& end, double exposed_area, const Patch& other,
                                          Random random) {
  const Patch& patch = *end.patch;
  const double share = exposed_area / patch.area;
  if (!end.partly_buried || above_horizon(other, patch) != 0) { return share; }
  Polygon upper;
  clip_to_horizon(patch.contour, other.centre, other.normal, upper);
  const double upper_area = upper.size() < 3 ? 0.0 : glm::length(vector_area(upper));
  if (!(upper_area > 0.0)) { return share; }
  int drawn = 0;
  int above = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    glm::dvec3 x{0.0};
    if (!draw_exposed(scene, end, i % 16, random, x)) { continue; }
    ++drawn;
    above += glm::dot(other.normal, x - other.centre) > 0.0 ? 1 : 0;
  }
  return drawn == 0 ? share : std::min(1.0, share * above / drawn * patch.area / upper_area);
}

// Sets the exchange of every link and removes those that carry nothing. `emits` tells for each input surface whether
// it is a light: its links make the shadows and get four times the segments where they are partly blocked.
[[nodiscard]] inline EvaluateResult evaluate(const raycast::Scene& scene, const Plan& plan, const std::vector<Surface>& surfaces,
                                             const Hierarchy& hierarchy, const Exposure& exposure, const std::vector<bool>& emits,
                                             Links& links, unsigned threads, std::uint64_t seed, const Control& control = {}) {
  EvaluateResult result;
  std::vector<Patch> patches(hierarchy.size());
  parallel_for(hierarchy.size(), threads,
               [&](std::size_t i) { patches[i] = make_patch(contour(surfaces, hierarchy, static_cast<std::uint32_t>(i))); });
  const auto end = [&](std::uint32_t i) {
    const Node& node = hierarchy[i];
    return PatchEnd{&patches[i], node.object, node.surface - surfaces[node.object].first_surface, exposure.partly_buried[i]};
  };

  std::vector<std::uint32_t> rays(links.size(), 0);
  constexpr std::size_t batch = 1 << 16;  // between two looks at the cancel flag
  for (std::size_t first = 0; first < links.size(); first += batch) {
    if (control.cancelled()) {
      result.cancelled = true;
      return result;
    }
    parallel_for(std::min(batch, links.size() - first), threads, [&](std::size_t offset) {
      if (control.cancelled()) { return; }
      Link& link = links[first + offset];
      const Patch& p = patches[link.p];
      const Patch& q = patches[link.q];
      if (!(exposure.area[link.p] > 0.0) || !(exposure.area[link.q] > 0.0)) { return; }
      const double unoccluded = exchange(p, q);
      if (!(unoccluded > 0.0)) { return; }
      const bool light = emits[hierarchy[link.p].surface] || emits[hierarchy[link.q].surface];
      const std::uint64_t key = (std::uint64_t{link.p} << 32) | link.q;
      const PatchEnd end_p = end(link.p);
      const PatchEnd end_q = end(link.q);
      const VisibilityEstimate seen = visibility(scene, plan, end_p, end_q, light ? 16 : 4, Random{seed, key});
      // On curved objects the area of the finer leaves counts too: the patch passes it on with its own kernel.
      const double shape = exposed_share(scene, end_p, exposure.area[link.p], q, Random{seed, key, 1}) *
                           exposed_share(scene, end_q, exposure.area[link.q], p, Random{seed, key, 2});
      link.exchange = static_cast<float>(unoccluded * seen.fraction * shape);
      rays[first + offset] = seen.rays;
      if (!hierarchy[link.p].leaf() || !hierarchy[link.q].leaf()) {
        const Slopes slope = slopes(p, q);
        link.slope_p = glm::vec3{slope.p};
        link.slope_q = glm::vec3{slope.q};
      }
    });
    control.report("link", static_cast<double>(std::min(first + batch, links.size())) / static_cast<double>(links.size()));
  }

  if (control.cancelled()) {
    result.cancelled = true;
    return result;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    result.rays += rays[i];
    if (links[i].exchange > 0.0f) {
      result.proven_clear += rays[i] == 0 ? 1 : 0;
      links[kept++] = links[i];
    } else {
      ++result.blocked;
    }
  }
  links.resize(kept);
  return result;
}

}  // namespace radiosity
