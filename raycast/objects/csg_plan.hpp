// SPDX-License-Identifier: MIT
#pragma once

// Decides how finely the leaves of a CSG tree are approximated, and where, and which of them are intersected with a box first.
//
// The requested chord tolerance applies to a part as large as the whole solid. A smaller leaf gets a smaller one, in powers of four, so
// that leaves of similar size have equal chords and coincide where their surfaces do. Around a small leaf, the others are as fine as it
// is. A leaf far larger than the solid is coarse except near the solid; there it is cut out on a grid of its own, because the common grid
// must resolve the solid. So the effort depends on the size of the solid, not on the size of its operands.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

struct CsgPlan {
  CsgTree tree;                    // its first leaves, and all its sheets but the last, are those of the given tree
  std::vector<double> tolerances;  // chord tolerance by leaf, outside the places
  std::vector<CsgPlace> places;
  std::size_t given_nodes;  // nodes from this index on belong to leaves that are intersected with a box
  bool finer = false;       // has any leaf or place a smaller tolerance than requested?
  std::string refusal;
};

namespace detail {

class CsgPlanner {
 public:
  // `tolerance`: for a part as large as the region, which must not be empty. Smaller parts get a smaller one, times `relax`.
  CsgPlanner(const CsgTree& tree, const CsgRegion& region, double tolerance, double relax);

  [[nodiscard]] CsgPlan run() { return std::move(plan_); }

 private:
  static constexpr double large = 8.0, largest = 0x1p17;  // relative to the size of the solid

  [[nodiscard]] double of_size(double size) const {
    const double steps = std::floor(std::log2(size_ / size) / 2 + 0.25);
    return steps > 0.0 ? std::min(tolerance_, std::ldexp(relax_ * tolerance_, -2 * static_cast<int>(std::min(steps, 24.0)))) : tolerance_;
  }

  [[nodiscard]] CsgTree::Share share_of(const CsgRegions& regions, std::uint32_t leaf, const Box& box) const;

  static std::string thousands(double x) { return std::to_string(static_cast<long long>(std::min(x, 1e15) / 1000)) + " 000"; }

  double tolerance_, relax_, size_;
  CsgPlan plan_;
};

}  // namespace detail

[[nodiscard]] inline CsgPlan csg_plan(const CsgTree& tree, const CsgRegion& region, double tolerance, double relax) {
  return detail::CsgPlanner(tree, region, tolerance, relax).run();
}

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_plan.cpp>
#endif
