// SPDX-License-Identifier: MIT

// Stage: reports sizes, rays and shortcuts.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <brep/inline.hpp>

#include <radiosity/audit/summary.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/saving.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> summarise(detail::Run& run) {
  const DiscreteScene& scene = run.scene;
  const Hierarchy& hierarchy = scene.hierarchy;
  const Links& links = run.solution.links;
  const Options& options = run.options;
  Audit& audit = run.solution.audit;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { audit.polygons += is_input_face(hierarchy, i) ? 1 : 0; }
  audit.nodes = hierarchy.size();
  audit.leaves = static_cast<std::uint64_t>(std::count_if(hierarchy.begin(), hierarchy.end(), [](const Node& n) { return n.leaf(); }));
  audit.leaf_splits = run.leaf_splits.count;
  audit.link_splits = run.link_splits.count;
  audit.links = links.size() + run.solution.ray_links.size();
  audit.ray_links = run.solution.ray_links.size();
  audit.stored_rays = run.ray_links.rays;
  audit.cluster_links = static_cast<std::uint64_t>(
      std::count_if(links.begin(), links.end(), [&](const Link& l) { return hierarchy[l.p].is_cluster() || hierarchy[l.q].is_cluster(); }));
  if (scene.light_meshing) { audit.imprinted = scene.light_meshing->imprinted(); }
  audit.proportion = summarise_proportions(hierarchy, scene.patches);
  RayCount rays = run.refined.rays;
  rays += run.evaluated.rays;
  audit.rays = rays.cast + run.rays_of_spacing + run.ray_links.rays;
  audit.rays_avoided = rays.avoided + run.refined.pairs_hidden * segments_per_round;
  audit.pairs_clear = run.evaluated.proven_clear;
  audit.pairs_hidden = run.refined.pairs_hidden;
  audit.bytes = hierarchy.capacity() * sizeof(Node) + (links.capacity() + run.solution.ray_links.capacity()) * sizeof(Link) + scene.bytes();
  report_left_out(audit, scene, run.refined, run.evaluated, options, link_cost(scene.evaluator, links));
  if (!run.t_vertices && options.reconstruction < Reconstruction::constant && options.topology == Topology::shared) {
    audit.left_out.push_back({"T-vertex elimination", "no leaf has a finer neighbour", ""});
  }
  if (run.leaf_splits.too_large > 0) {
    audit.left_out.push_back({"splitting leaves over which light varies", "memory would not suffice", ""});
  }
  if (run.needs_links() && !run.rays.cast) {
    audit.left_out.push_back({"stored rays for the light between surfaces that do not shine", run.rays.reason, ""});
  }
  if (run.needs_links() && !run.clusters.build) { audit.left_out.push_back({"clusters above the input faces", run.clusters.reason, ""}); }
  if (scene.any_closed() && audit.links > 0 && !audit.closure) {
    audit.left_out.push_back({"closing the scene", "its row sums need a larger correction than quadrature and sampling explain", ""});
  }
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
