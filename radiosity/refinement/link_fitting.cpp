// SPDX-License-Identifier: MIT
#include <radiosity/refinement/link_fitting.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/lit_faces.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

HALFLIGHT_INLINE void fit_links(DiscreteScene& scene, Links& links, const std::vector<double>& before) {
  const std::vector<double>& area = scene.exposure.area;
  const auto grown = [&](std::uint32_t i) { return i < before.size() && before[i] > 0.0 ? area[i] / before[i] : 1.0; };
  const auto is_new = [&](std::uint32_t i) { return std::abs(grown(i) - 1.0) > 1e-12; };
  for (Link& link : links) {
    if (!scene.evaluator.between_patches(link) || (!is_new(link.p) && !is_new(link.q))) { continue; }
    link.exchange = static_cast<float>(static_cast<double>(link.exchange) * grown(link.p) * grown(link.q));
  }
  if (!scene.clustered()) { return; }
  ShownAreas now = scene.exposed_shown();
  for (Link& link : links) {
    if (!scene.evaluator.between_patches(link)) { refit_cluster_link(scene.hierarchy, link, scene.shown, now); }
  }
  scene.shown = std::move(now);
}

HALFLIGHT_INLINE bool at_blade(const DiscreteScene& scene, std::uint32_t leaf) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const Surface& surface = scene.surfaces[hierarchy[leaf].object];
  if (surface.object->flat() || surface.topology != Topology::shared) { return false; }
  for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, hierarchy[leaf].face)) {
    const std::uint32_t other = surface.brep.data(surface.brep.face(brep::twin(h))).node;
    if (other != no_node && glm::dot(hierarchy[leaf].normal, hierarchy[other].normal) < -0.1) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE double lit_area(const DiscreteScene& scene) {
  std::vector<bool> buried(scene.hierarchy.size());
  for (std::size_t i = 0; i < buried.size(); ++i) { buried[i] = !(scene.exposure.area[i] > 0.0); }
  return LitFaces{scene.view(), scene.reflectance, scene.emission, buried}.area();
}

}  // namespace radiosity
