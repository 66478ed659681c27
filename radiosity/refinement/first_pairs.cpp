// SPDX-License-Identifier: MIT
#include <radiosity/refinement/first_pairs.hpp>

#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/proof_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/refine_result.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity::detail {

HALFLIGHT_INLINE std::vector<std::uint32_t> tops(const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].parent == no_node) { result.push_back(i); }
  }
  return result;
}

HALFLIGHT_INLINE void first_pairs(const DiscreteScene& scene, const ProofOracle& proofs, Linked linked, NodePairs& pairs,
                                  RefineResult& result) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const auto count = static_cast<std::uint32_t>(hierarchy.size());
  const auto counts = [&](std::uint32_t i) {
    return linked == Linked::all || hierarchy[i].is_cluster() || scene.lamps[hierarchy[i].surface];
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_input_face(hierarchy, i) || proofs.buried(i) || !counts(i)) { continue; }
    const raycast::PlacedObject& object = *scene.surfaces[hierarchy[i].object].object;
    if ((object.inside() || !object.convex()) && !object.flat()) { result.inner.push_back(i); }
  }
  if (scene.clustered()) {
    pairs.push_back({0, 0});
    return;
  }
  const std::vector<std::uint32_t> on_top = tops(hierarchy);
  for (const std::uint32_t p : on_top) {
    if (!counts(p)) { continue; }
    if (hierarchy[p].is_cluster()) { pairs.push_back({p, p}); }
    for (const std::uint32_t q : on_top) {
      if (q == p || (q < p && (linked == Linked::all || counts(q)))) { continue; }
      if (!proofs.convex(hierarchy[p], hierarchy[q])) {
        pairs.push_back({p, q});
      } else if (scene.plan.shortcuts || hierarchy[p].deviation > 0.0 || hierarchy[q].deviation > 0.0) {
        ++result.pairs_convex;
      } else {
        result.linked.push_back({p, q, OccluderLists::hidden});
      }
    }
  }
}

}  // namespace radiosity::detail
