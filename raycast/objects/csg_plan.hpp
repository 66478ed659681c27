// SPDX-License-Identifier: MIT
#pragma once

// How finely the leaves of a CSG tree are approximated, and where; and which of them are cut down first.
//
// The chord tolerance that is asked for is meant for a part as large as the solid. A smaller leaf gets a smaller one, by powers of four, so
// that leaves of like size keep equal chords and coincide where their surfaces do. Around a small leaf, the others are as fine as it is. A
// leaf that is far larger than the solid is coarse, but for the surroundings of the solid; it is cut off there on a grid of its own, for
// the common grid must resolve the solid. So the effort follows the solid, not the size of what it was cut from.

#include <cmath>
#include <string>
#include <vector>

#include "box.hpp"
#include "csg_leaf.hpp"
#include "csg_region.hpp"

namespace raycast {

struct CsgPlan {
  CsgTree tree;                    // its first leaves and all their sheets are those of the given one
  std::vector<double> tolerances;  // of each leaf: of its chords, but at the places
  std::vector<CsgPlace> places;
  std::size_t given_nodes;  // nodes from here on belong to leaves that are cut down
  bool finer = false;       // is there a leaf or place with a smaller tolerance than was asked for?
  std::string refusal;
};

namespace detail {

class CsgPlanner {
 public:
  // `tolerance`: for a part as large as the whole of the region, which is not empty. Smaller parts get a smaller one, times `relax`.
  CsgPlanner(const CsgTree& tree, const CsgRegion& region, double tolerance, double relax)
      : tolerance_(tolerance), relax_(relax), size_(region.whole.diameter()), plan_{tree, {}, {}, tree.nodes().size(), false, {}} {
    const auto& leaves = tree.leaves();
    std::vector<CsgTree::Share> shares(leaves.size(), CsgTree::Share::all);
    const Box surroundings = region.whole.grown(0.25 * size_);
    const CsgRegions regions(tree);
    bool cut = false;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      const double size = leaves[i].solid.bounds().diameter();
      plan_.tolerances.push_back(of_size(size));
      plan_.finer = plan_.finer || plan_.tolerances.back() < tolerance_;
      if (const Box& own = region.leaves[i]; !own.empty() && own.diameter() > 0.0) {
        const double here = of_size(std::min(size, own.diameter()));
        plan_.finer = plan_.finer || here < tolerance_;
        if (here < tolerance_) plan_.places.push_back({own.grown(0.25 * own.diameter()), here});
      }
      if (size <= large * size_) continue;
      cut = true;
      shares[i] = share_of(regions, i, surroundings);
      if (shares[i] != CsgTree::Share::within) continue;
      plan_.tolerances[i] = std::max(tolerance_, 0.01 * size);
      if (size > largest * size_ && plan_.refusal.empty())
        plan_.refusal = "'" + std::string(tree.sheet_name(leaves[i].first_sheet)) + "' is " + thousands(size / size_) +
                        " times as large as what is left of the solid, too large to know its surface there: cut it down to what is needed";
    }
    if (!cut) return;
    plan_.places.push_back({surroundings, tolerance_});
    plan_.tree = tree.cut(shares, BoxObject::make(surroundings.lo, surroundings.hi).object);
    plan_.tolerances.resize(plan_.tree.leaves().size(), tolerance_);
  }

  [[nodiscard]] CsgPlan run() { return std::move(plan_); }

 private:
  static constexpr double large = 8.0, largest = 0x1p17;  // in sizes of the solid

  [[nodiscard]] double of_size(double size) const {
    const double steps = std::floor(std::log2(size_ / size) / 2 + 0.25);
    return steps > 0.0 ? std::min(tolerance_, std::ldexp(relax_ * tolerance_, -2 * static_cast<int>(std::min(steps, 24.0)))) : tolerance_;
  }

  [[nodiscard]] CsgTree::Share share_of(const CsgRegions& regions, std::uint32_t leaf, const Box& box) const {
    constexpr int cells = 8;
    const glm::dvec3 step = box.size() / static_cast<double>(cells);
    bool inside = false, outside = false;
    for (int i = 0; i < cells * cells * cells; ++i) {
      const glm::dvec3 lo = box.lo + glm::dvec3(i % cells, i / cells % cells, i / cells / cells) * step;
      const CsgRegions::Where where = regions.where(leaf, Box{lo, lo + step}.grown(1e-9 * size_));
      if (where == CsgRegions::Where::unknown) return CsgTree::Share::within;
      (where == CsgRegions::Where::inside ? inside : outside) = true;
    }
    return inside && outside ? CsgTree::Share::within : inside ? CsgTree::Share::full : CsgTree::Share::none;
  }

  static std::string thousands(double x) { return std::to_string(static_cast<long long>(std::min(x, 1e15) / 1000)) + " 000"; }

  double tolerance_, relax_, size_;
  CsgPlan plan_;
};

}  // namespace detail

[[nodiscard]] inline CsgPlan csg_plan(const CsgTree& tree, const CsgRegion& region, double tolerance, double relax = 1.0) {
  return detail::CsgPlanner(tree, region, tolerance, relax).run();
}

}  // namespace raycast
