// SPDX-License-Identifier: MIT
#include <radiosity/refinement/measured_light.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/discontinuity/light_meshing.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

HALFLIGHT_INLINE MeasuredLight::MeasuredLight(DiscreteScene& scene, const std::vector<bool>& buried, double scene_area,
                                              double light_epsilon, double min_area)
    : scene_{&scene}, min_area_{min_area} {
  if (!scene.light_meshing || !(scene_area > 0.0)) { return; }
  const Hierarchy& hierarchy = scene.hierarchy;
  std::vector<std::uint32_t> faces;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    const bool hidden = i < buried.size() && buried[i];
    if (is_input_face(hierarchy, i) && LightMeshing::measurable(hierarchy[i]) && !hidden) { faces.push_back(i); }
  }
  scene.patches.extend(scene.threads);
  measure_nodes(faces);
  double square = 0.0;  // sum of squares times area
  for (const std::uint32_t i : faces) { square += hierarchy[i].area * scene.light_meshing->light_on(i).square; }
  const double share = 0.25 * light_epsilon;
  least_ = share * share * square;
}

HALFLIGHT_INLINE std::uint32_t MeasuredLight::receiver(const NodePair& pair) const {
  if (!scene_->light_meshing) { return no_node; }
  const LightMeshing& light = *scene_->light_meshing;
  const bool from_p = light.is_lamp(scene_->hierarchy[pair.p]);
  if (from_p == light.is_lamp(scene_->hierarchy[pair.q])) { return no_node; }
  const std::uint32_t receiver = from_p ? pair.q : pair.p;
  return LightMeshing::measurable(scene_->hierarchy[receiver]) ? receiver : no_node;
}

HALFLIGHT_INLINE bool MeasuredLight::takes_whole_lamp(const NodePair& pair) const {
  const std::uint32_t to = receiver(pair);
  return to != no_node && scene_->light_meshing->is_even_lamp(scene_->hierarchy[to == pair.p ? pair.q : pair.p]);
}

HALFLIGHT_INLINE void MeasuredLight::measure(const NodePairs& pairs) {
  if (!scene_->light_meshing) { return; }
  std::vector<std::uint32_t> nodes;
  for (const NodePair& pair : pairs) {
    const std::uint32_t to = receiver(pair);
    if (to != no_node && !scene_->light_meshing->measured(to)) { nodes.push_back(to); }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  measure_nodes(std::move(nodes));
}

HALFLIGHT_INLINE Decision MeasuredLight::operator()(const NodePair& pair) const {
  const std::uint32_t to = receiver(pair);
  const Node& node = scene_->hierarchy[to];
  if (!(node.area > min_area_) || !(scene_->light_meshing->light_on(to).variance * node.area > least_)) { return Decision::link; }
  return to == pair.p ? Decision::split_p : Decision::split_q;
}

HALFLIGHT_INLINE void MeasuredLight::measure_nodes(std::vector<std::uint32_t> nodes) {
  scene_->light_meshing->measure(nodes, scene_->hierarchy, scene_->patches, scene_->surfaces, scene_->threads);
}

}  // namespace radiosity
