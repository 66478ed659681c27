// SPDX-License-Identifier: MIT
#include <radiosity/oracle/cluster_oracle.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

HALFLIGHT_INLINE double most_shown(const Node& node, const ShownAreas& shown, const glm::dvec3& d, double spread) {
  if (!node.is_cluster()) { return node.area * std::clamp(glm::dot(node.normal, d) + spread, 0.0, 1.0); }
  const Aim towards = aim(d);
  double most = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::uint32_t k = towards.direction[j];
    const glm::dvec3 lattice{detail::direction_lattice.x[k], detail::direction_lattice.y[k], detail::direction_lattice.z[k]};
    most = std::max(most, shown.of(node)[k] / glm::length(lattice));
  }
  return std::min(most, std::numbers::pi * node.radius * node.radius);
}

HALFLIGHT_INLINE Decision ClusterOracle::operator()(const Question& question) const {
  const Node& a = question.node_p();
  const Node& b = question.node_q();
  const double min_area = question.min_area;
  // If a patch may not be split any further, the cluster is split.
  const auto splits = [&](const Node& node) { return node.is_cluster() || !node.leaf() || node.area > min_area; };
  const Decision larger = splits(a) && (a.radius >= b.radius || !splits(b)) ? Decision::split_p : Decision::split_q;
  const glm::dvec3 to_b = b.centre - a.centre;
  const double r = glm::length(to_b);
  const double extent = a.radius + b.radius;
  if (!(r >= cluster_separation * extent)) { return larger; }
  if (std::max(a.area, b.area) <= min_area) { return Decision::link; }
  const glm::dvec3 d = to_b / r;
  const double spread = extent / r;
  const double seen = std::max(most_shown(a, question.shown, d, spread), most_shown(b, question.shown, -d, spread));
  return seen <= question.epsilon * std::numbers::pi * (r * r + seen) ? Decision::link : larger;
}

}  // namespace radiosity
