// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_plan.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/box.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

HALFLIGHT_INLINE CsgPlanner::CsgPlanner(const CsgTree& tree, const CsgRegion& region, double tolerance, double relax)
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
      if (here < tolerance_) { plan_.places.push_back({own.grown(0.25 * own.diameter()), here}); }
    }
    if (size <= large * size_) { continue; }
    cut = true;
    shares[i] = share_of(regions, i, surroundings);
    if (shares[i] != CsgTree::Share::within) { continue; }
    plan_.tolerances[i] = std::max(tolerance_, tol_chord * size);
    if (size > largest * size_ && plan_.refusal.empty()) {
      plan_.refusal = "'" + std::string(tree.sheet_name(leaves[i].first_sheet)) + "' is " + thousands(size / size_) +
                      " times as large as what is left of the solid, too large to know its surface there: cut it down to what is needed";
    }
  }
  if (!cut) { return; }
  plan_.places.push_back({surroundings, tolerance_});
  plan_.tree = tree.cut(shares, BoxObject::make(surroundings.lo, surroundings.hi).object);
  plan_.tolerances.resize(plan_.tree.leaves().size(), tolerance_);
}

HALFLIGHT_INLINE CsgTree::Share CsgPlanner::share_of(const CsgRegions& regions, std::uint32_t leaf, const Box& box) const {
  constexpr int cells = 8;
  const glm::dvec3 step = box.size() / static_cast<double>(cells);
  bool inside = false, outside = false;
  for (int i = 0; i < cells * cells * cells; ++i) {
    const glm::dvec3 lo = box.lo + glm::dvec3(i % cells, i / cells % cells, i / cells / cells) * step;
    const CsgRegions::Where where = regions.where(leaf, Box{lo, lo + step}.grown(tol_cell * size_));
    if (where == CsgRegions::Where::unknown) { return CsgTree::Share::within; }
    (where == CsgRegions::Where::inside ? inside : outside) = true;
  }
  return inside && outside ? CsgTree::Share::within : inside ? CsgTree::Share::full : CsgTree::Share::none;
}

}  // namespace detail

}  // namespace raycast
