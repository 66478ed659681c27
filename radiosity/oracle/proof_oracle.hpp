// SPDX-License-Identifier: MIT
#pragma once

// Finds pairs of nodes that provably do not see each other, whatever stands between them: faces in one plane or on one convex solid,
// buried faces, and patches that face away from each other. Asked about every pair before any other oracle.

#include <cstdint>
#include <vector>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

class ProofOracle {
 public:
  // The references must outlive the oracle. At construction the hierarchy holds only clusters and input faces; it may grow afterwards.
  ProofOracle(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy)
      : surfaces_{&surfaces}, buried_{buried_nodes(surfaces, hierarchy)} {}

  // Do both nodes lie in one plane or on one convex solid?
  [[nodiscard]] bool convex(const Node& a, const Node& b) const {
    if (a.object != b.object || a.object == no_node) { return false; }
    const raycast::PlacedObject& object = *(*surfaces_)[a.object].object;
    const bool sees_itself = object.inside() || !object.convex();
    return !sees_itself || (object.flat() && a.surface == b.surface && a.surface != no_node);
  }
  // Is this node buried? False for nodes made after the oracle.
  [[nodiscard]] bool buried(std::uint32_t i) const { return i < buried_.size() && buried_[i]; }
  [[nodiscard]] const std::vector<bool>& buried() const { return buried_; }
  // The proof, or Decision::link if there is none. A cluster paired with itself is split.
  [[nodiscard]] Decision operator()(const Question& question) const {
    const Node& p = question.node_p();
    const Node& q = question.node_q();
    if (convex(p, q)) { return Decision::convex; }
    if (buried(question.p) || buried(question.q)) { return Decision::hide; }
    if (question.p == question.q) { return Decision::split_p; }
    return !p.is_cluster() && !q.is_cluster() && face_away(p, q) ? Decision::drop : Decision::link;
  }

 private:
  const std::vector<Surface>* surfaces_;
  std::vector<bool> buried_;
};
static_assert(Oracle<ProofOracle>);

}  // namespace radiosity
