// SPDX-License-Identifier: MIT
#include <radiosity/oracle/lamp_oracle.hpp>

#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/cluster_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

HALFLIGHT_INLINE Decision LampOracle::operator()(const Question& question) const {
  const Node& p = question.node_p();
  const Node& q = question.node_q();
  if (p.is_cluster() && q.is_cluster()) { return ClusterOracle{}(question); }
  const bool p_shines = p.is_cluster();
  const Node& lamp = p_shines ? p : q;
  const Node& to = p_shines ? q : p;
  const Decision open_lamp = p_shines ? Decision::split_p : Decision::split_q;
  const Decision split = p_shines ? Decision::split_q : Decision::split_p;
  const bool can_split = question.can_split(p_shines ? question.q : question.p);
  const glm::dvec3 d = lamp.centre - to.centre;
  const double r = glm::length(d);
  const double extent = lamp.radius + to.radius;
  if (!(r >= lamp_separation * extent)) { return can_split && to.radius > lamp.radius ? split : open_lamp; }
  const double seen = most_shown(to, question.shown, d / r, extent / r);
  return can_split && seen > question.epsilon * std::numbers::pi * (r * r + seen) ? split : Decision::link;
}

}  // namespace radiosity
