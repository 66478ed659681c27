// SPDX-License-Identifier: MIT
#include <radiosity/oracle/f_oracle.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/cluster_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

HALFLIGHT_INLINE glm::dvec3 nearest_point(const Node& patch, const glm::dvec3& x) {
  const glm::dvec3 d = x - patch.centre;
  const glm::dvec3 in_plane = d - glm::dot(d, patch.normal) * patch.normal;
  const double length = glm::length(in_plane);
  return patch.centre + (length > patch.radius ? patch.radius / length : 1.0) * in_plane;
}

// Upper bound of the height of q, or of any finer part of it, above the plane of p or of any finer part of p: the height of q's centre
// plus the extent of its disk along p's normal. On curved objects finer parts bulge and tilt according to the deviation of their normals.
[[nodiscard]] HALFLIGHT_INLINE double reach_above(const Node& p, const Node& q) {
  const glm::dvec3 d = q.centre - p.centre;
  const double cosine = glm::dot(p.normal, q.normal);
  const double flat = glm::dot(p.normal, d) + q.radius * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  if (p.deviation == 0.0 && q.deviation == 0.0) { return flat; }
  return flat + q.radius * q.deviation + p.deviation * (glm::length(d) + q.radius);
}

HALFLIGHT_INLINE double form_factor_estimate(const Node& p, const Node& q) {
  const glm::dvec3 d = q.centre - p.centre;
  const double r = glm::length(d);
  if (!(r > 0.0)) { return 1.0; }
  constexpr double even = 1.0 - 0x1p-30;
  const auto cosine = [&](const Node& from, const Node& to) {
    const double centre = glm::dot(from.normal, to.centre - from.centre);
    const double highest = reach_above(from, to);
    const bool crosses = 2.0 * centre < even * highest;  // the lowest point is as far below the centre as the highest is above
    return std::clamp((crosses ? highest : centre) / r, 0.0, 1.0);
  };
  const double area = std::max(p.area, q.area);
  const double estimate = cosine(p, q) * cosine(q, p) * area / (std::numbers::pi * r * r + area);
  if (r >= 2.0 * even * (p.radius + q.radius)) { return estimate; }
  const Node& large = p.radius >= even * q.radius ? p : q;
  const Node& small = &large == &p ? q : p;
  return std::max(estimate, disk_estimate(small.centre, small.normal, nearest_point(large, small.centre), large.normal, large.area));
}

HALFLIGHT_INLINE bool face_away(const Node& p, const Node& q) {
  const double slack = 1e-9 * (p.radius + q.radius + glm::length(q.centre - p.centre));
  return reach_above(p, q) + q.rim <= slack || reach_above(q, p) + p.rim <= slack;
}

HALFLIGHT_INLINE Decision f_rule(const Node& p, const Node& q, double epsilon, double min_area) {
  if (p.in_parts() && p.child_count > most_linked_parts) { return Decision::split_p; }
  if (q.in_parts() && q.child_count > most_linked_parts) { return Decision::split_q; }
  if (form_factor_estimate(p, q) <= epsilon) { return Decision::link; }
  if (std::max(p.area, q.area) <= min_area) { return Decision::link; }
  return q.area > p.area * (1.0 + 0x1p-20) ? Decision::split_q : Decision::split_p;
}

HALFLIGHT_INLINE Decision FOracle::operator()(const Question& question) const {
  const Node& p = question.node_p();
  const Node& q = question.node_q();
  if (p.is_cluster() || q.is_cluster()) { return ClusterOracle{}(question); }
  return f_rule(p, q, question.epsilon, question.min_area);
}

}  // namespace radiosity
