// SPDX-License-Identifier: MIT
#include <radiosity/refinement/whole_lamps.hpp>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE std::uint64_t lamp_and_patch(std::uint32_t lamp, std::uint32_t patch) {
  return std::uint64_t{lamp} << 32 | patch;
}

}  // namespace detail

HALFLIGHT_INLINE bool WholeLamps::opens(const NodePair& pair, Decision decision) const {
  // Least area of the faces, relative to a disk of the sphere's radius. That of a ball is 4, of a flat square 0.6, of lamps spread over a
  // room next to nothing.
  constexpr double least_filled = 0.3;
  const bool all_clustered = hierarchy_->front().is_cluster();
  if (all_clustered || (decision != Decision::split_p && decision != Decision::split_q)) { return false; }
  const bool opens_p = decision == Decision::split_p;
  const Node& lamp = (*hierarchy_)[opens_p ? pair.p : pair.q];
  const Node& to = (*hierarchy_)[opens_p ? pair.q : pair.p];
  return lamp.is_cluster() && !to.is_cluster() && lamp.area > least_filled * std::numbers::pi * lamp.radius * lamp.radius;
}

HALFLIGHT_INLINE bool WholeLamps::reaches_in(const NodePair& pair) const {
  const Node &p = (*hierarchy_)[pair.p], &q = (*hierarchy_)[pair.q];
  return !(glm::length(p.centre - q.centre) > p.radius + q.radius);
}

HALFLIGHT_INLINE Decision WholeLamps::split_within(const Question& question, Decision decision) const {
  const bool opens_p = decision == Decision::split_p;
  const Node& lamp = opens_p ? question.node_p() : question.node_q();
  const Node& to = opens_p ? question.node_q() : question.node_p();
  if (!(to.radius > 0.25 * lamp.radius) || !question.can_split(opens_p ? question.q : question.p)) { return decision; }
  return opens_p ? Decision::split_q : Decision::split_p;
}

HALFLIGHT_INLINE bool WholeLamps::settled(const NodePair& pair) const {
  if (settled_.empty()) { return false; }
  const auto above = [&](std::uint32_t part, std::uint32_t of_patch) {
    for (std::uint32_t lamp = part; lamp != no_node; lamp = (*hierarchy_)[lamp].parent) {
      if (!(*hierarchy_)[lamp].is_cluster()) { continue; }
      for (std::uint32_t patch = of_patch; patch != no_node; patch = (*hierarchy_)[patch].parent) {
        if (settled_.contains(detail::lamp_and_patch(lamp, patch))) { return true; }
      }
    }
    return false;
  };
  return above(pair.p, pair.q) || above(pair.q, pair.p);
}

HALFLIGHT_INLINE void WholeLamps::settle(const NodePairs& pairs, const std::vector<Decision>& decisions) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const NodePair& pair = pairs[i];
    if (!opens(pair, decisions[i]) || reaches_in(pair) || settled(pair)) { continue; }
    const bool opens_p = decisions[i] == Decision::split_p;
    settled_.insert(detail::lamp_and_patch(opens_p ? pair.p : pair.q, opens_p ? pair.q : pair.p));
  }
}

}  // namespace radiosity
