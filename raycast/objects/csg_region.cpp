// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_region.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

HALFLIGHT_INLINE CsgRegions::CsgRegions(const CsgTree& tree) : tree_(tree) {
  for (const CsgTree::Leaf& leaf : tree.leaves()) {
    // project() finds the nearest point before the placement, so the true distance is smaller by at most the condition number
    // of the placement.
    const glm::dmat3& linear = leaf.solid.placement().linear;
    const double condition = stretch(linear) * stretch(glm::inverse(linear));
    shrink_.push_back(leaf.solid.object().nearest() && leaf.solid.sheet_count() <= most_sheets ? 1.0 / condition : 0.0);
  }
}

HALFLIGHT_INLINE CsgRegion CsgRegions::run() const {
  CsgRegion result{tree_.bounds(), {}};
  const double touching = tol_touching * tree_.bounds().diameter();
  for (int round = 0; round < 80 && !result.whole.empty(); ++round) {
    const double before = result.whole.diameter();
    result = inside(result.whole);
    if (!(result.whole.diameter() > touching)) {
      return {{}, std::vector<Box>(tree_.leaves().size())};  // a common point is not a solid
    }
    if (result.whole.diameter() > 0.8 * before) { break; }
  }
  return result;
}

HALFLIGHT_INLINE CsgRegions::Where CsgRegions::where(std::uint32_t leaf, const Box& cell) const {
  const PlacedObject& solid = tree_.leaves()[leaf].solid;
  if (!cell.meets(solid.bounds())) { return Where::outside; }
  if (shrink_[leaf] == 0.0) { return Where::unknown; }
  const glm::dvec3 middle = cell.centre();
  const double radius = 0.5 * cell.diameter() / shrink_[leaf] * (1.0 + tol_cell) + tol_cell_place * cell.magnitude();
  bool near = false, convex = solid.convex();
  for (std::uint32_t s = 0; s < solid.sheet_count(); ++s) {
    const SurfacePoint on = solid.project(s, middle);
    const glm::dvec3 way = middle - on.position;
    if (convex && glm::dot(way, on.normal) > radius) {
      return Where::outside;  // a convex solid lies behind each of its sheets
    }
    near = near || !(glm::length(way) > radius);
  }
  if (near) { return Where::unknown; }
  Spans through;
  solid.spans(Segment{middle, glm::dvec3(0.6, 0.64, 0.48)}, through);
  const bool in = std::any_of(through.begin(), through.end(), [](const Span& s) { return s.in.t < 0.0 && s.out.t > 0.0; });
  return in ? Where::inside : Where::outside;
}

HALFLIGHT_INLINE CsgRegion CsgRegions::inside(const Box& box) const {
  CsgRegion result{{}, std::vector<Box>(tree_.leaves().size())};
  const glm::dvec3 step = box.size() / static_cast<double>(cells);
  std::vector<Where> of_leaf(tree_.leaves().size()), of_node(tree_.nodes().size());
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        Box cell;
        const auto corner = [&](int a, int b, int c) {  // the last corners equal those of the box, whatever the rounding
          return glm::dvec3(a == cells ? box.hi.x : box.lo.x + a * step.x, b == cells ? box.hi.y : box.lo.y + b * step.y,
                            c == cells ? box.hi.z : box.lo.z + c * step.z);
        };
        cell.extend(corner(i, j, k));
        cell.extend(corner(i + 1, j + 1, k + 1));
        for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf) { of_leaf[leaf] = where(leaf, cell); }
        const Where all = of_tree(of_leaf, of_node);
        if (all == Where::outside) { continue; }
        result.whole.extend(cell);
        if (all == Where::inside) { continue; }
        for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf) {
          if (of_leaf[leaf] == Where::unknown) { result.leaves[leaf].extend(cell); }
        }
      }
    }
  }
  for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf) {
    Box& own = result.leaves[leaf];
    own.lo = glm::max(own.lo, tree_.leaves()[leaf].solid.bounds().lo);
    own.hi = glm::min(own.hi, tree_.leaves()[leaf].solid.bounds().hi);
  }
  return result;
}

HALFLIGHT_INLINE CsgRegions::Where CsgRegions::of_tree(const std::vector<Where>& of_leaf, std::vector<Where>& of_node) const {
  for (std::size_t n = of_node.size(); n-- > 0;) {
    const CsgTree::Node& node = tree_.nodes()[n];
    if (node.parts.empty()) {
      of_node[n] = of_leaf[node.leaf];
      continue;
    }
    const bool unite = node.operation == CsgOperation::unite;
    // `decides` is the value that, in one part, determines the whole; `otherwise` is the value of the whole if no part has it.
    const Where decides = unite ? Where::inside : Where::outside, otherwise = unite ? Where::outside : Where::inside;
    Where value = otherwise;
    for (std::size_t i = 0; i < node.parts.size(); ++i) {
      Where part = of_node[node.parts[i]];
      if (node.operation == CsgOperation::subtract && i > 0 && part != Where::unknown) {
        part = part == Where::inside ? Where::outside : Where::inside;
      }
      if (part == decides) {
        value = decides;
        break;
      }
      if (part == Where::unknown) { value = Where::unknown; }
    }
    of_node[n] = value;
  }
  return of_node[0];
}

}  // namespace detail

}  // namespace raycast
