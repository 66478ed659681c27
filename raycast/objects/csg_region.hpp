// SPDX-License-Identifier: MIT
#pragma once

// Where a CSG tree can have its solid, and where each leaf can matter: boxes that are found without a mesh.
//
// A cell of space is outside of a leaf, inside of it, or not known to be either. The distance from its middle to the sheets decides: where
// it is more than the radius of the cell, no surface passes through. From the leaves follow the nodes of the tree (an interval of truth
// values). A grid of cells is laid over the bounds, those that are outside for certain are dropped, and a grid over the rest comes next; so
// a lens in which two large spheres just meet is found in some ten rounds. What is dropped is certainly outside, so an empty region is a
// proof.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "csg_tree.hpp"

namespace raycast {

struct CsgRegion {
  Box whole;                // no part of the solid lies outside; empty: there is none
  std::vector<Box> leaves;  // within it no surface of the leaf takes part in the solid outside of this box; empty: nowhere
};

namespace detail {

class CsgRegions {
 public:
  explicit CsgRegions(const CsgTree& tree) : tree_(tree) {
    for (const CsgTree::Leaf& leaf : tree.leaves()) {
      // project() finds the nearest point before the placement, so that a distance is known up to the condition of that.
      const glm::dmat3& linear = leaf.solid.placement().linear;
      const double condition = stretch(linear) * stretch(glm::inverse(linear));
      shrink_.push_back(leaf.solid.object().nearest() && leaf.solid.sheet_count() <= most_sheets ? 1.0 / condition : 0.0);
    }
  }

  [[nodiscard]] CsgRegion run() const {
    CsgRegion result{tree_.bounds(), {}};
    const double touching = 0x1p-24 * tree_.bounds().diameter();
    for (int round = 0; round < 80 && !result.whole.empty(); ++round) {
      const double before = result.whole.diameter();
      result = inside(result.whole);
      if (!(result.whole.diameter() > touching)) return {{}, std::vector<Box>(tree_.leaves().size())};  // a common point is no solid
      if (result.whole.diameter() > 0.8 * before) break;
    }
    return result;
  }

  enum class Where : std::uint8_t { outside, inside, unknown };

  // Of all points of the box.
  [[nodiscard]] Where where(std::uint32_t leaf, const Box& cell) const {
    const PlacedObject& solid = tree_.leaves()[leaf].solid;
    const Box& bounds = solid.bounds();
    for (int k = 0; k < 3; ++k)
      if (cell.lo[k] > bounds.hi[k] || cell.hi[k] < bounds.lo[k]) return Where::outside;
    if (shrink_[leaf] == 0.0) return Where::unknown;
    const glm::dvec3 middle = cell.centre();
    const double radius = 0.5 * cell.diameter() / shrink_[leaf] * (1.0 + 1e-9) + 0x1p-40 * cell.magnitude();
    bool near = false, convex = solid.convex();
    for (std::uint32_t s = 0; s < solid.sheet_count(); ++s) {
      const SurfacePoint on = solid.project(s, middle);
      const glm::dvec3 way = middle - on.position;
      if (convex && glm::dot(way, on.normal) > radius) return Where::outside;  // a convex solid lies behind each of its sheets
      near = near || !(glm::length(way) > radius);
    }
    if (near) return Where::unknown;
    Spans through;
    solid.spans(Segment{middle, glm::dvec3(0.6, 0.64, 0.48)}, through);
    const bool in = std::any_of(through.begin(), through.end(), [](const Span& s) { return s.in.t < 0.0 && s.out.t > 0.0; });
    return in ? Where::inside : Where::outside;
  }

 private:
  static constexpr std::uint32_t most_sheets = 64;  // of a mesh with more it is not worth while to look at all
  static constexpr int cells = 8;

  // One round.
  [[nodiscard]] CsgRegion inside(const Box& box) const {
    CsgRegion result{{}, std::vector<Box>(tree_.leaves().size())};
    const glm::dvec3 step = box.size() / static_cast<double>(cells);
    std::vector<Where> of_leaf(tree_.leaves().size()), of_node(tree_.nodes().size());
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j)
        for (int k = 0; k < cells; ++k) {
          Box cell;
          const auto corner = [&](int a, int b, int c) {  // the last ones are those of the box, however rounding falls
            return glm::dvec3(a == cells ? box.hi.x : box.lo.x + a * step.x, b == cells ? box.hi.y : box.lo.y + b * step.y,
                              c == cells ? box.hi.z : box.lo.z + c * step.z);
          };
          cell.extend(corner(i, j, k));
          cell.extend(corner(i + 1, j + 1, k + 1));
          for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf) of_leaf[leaf] = where(leaf, cell);
          const Where all = of_tree(of_leaf, of_node);
          if (all == Where::outside) continue;
          result.whole.extend(cell);
          if (all == Where::inside) continue;
          for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf)
            if (of_leaf[leaf] == Where::unknown) result.leaves[leaf].extend(cell);
        }
    for (std::uint32_t leaf = 0; leaf < of_leaf.size(); ++leaf) {
      Box& own = result.leaves[leaf];
      own.lo = glm::max(own.lo, tree_.leaves()[leaf].solid.bounds().lo);
      own.hi = glm::min(own.hi, tree_.leaves()[leaf].solid.bounds().hi);
    }
    return result;
  }

  // Parts stand behind their node.
  [[nodiscard]] Where of_tree(const std::vector<Where>& of_leaf, std::vector<Where>& of_node) const {
    for (std::size_t n = of_node.size(); n-- > 0;) {
      const CsgTree::Node& node = tree_.nodes()[n];
      if (node.parts.empty()) {
        of_node[n] = of_leaf[node.leaf];
        continue;
      }
      const bool unite = node.operation == CsgOperation::unite;
      // The value that one part gives to the whole, whatever the others are; and the one that it has when all parts have the other.
      const Where decides = unite ? Where::inside : Where::outside, otherwise = unite ? Where::outside : Where::inside;
      Where value = otherwise;
      for (std::size_t i = 0; i < node.parts.size(); ++i) {
        Where part = of_node[node.parts[i]];
        if (node.operation == CsgOperation::subtract && i > 0 && part != Where::unknown)
          part = part == Where::inside ? Where::outside : Where::inside;
        if (part == decides) {
          value = decides;
          break;
        }
        if (part == Where::unknown) value = Where::unknown;
      }
      of_node[n] = value;
    }
    return of_node[0];
  }

  const CsgTree& tree_;
  std::vector<double> shrink_;  // of each leaf: what of a distance by project() is certain
};

}  // namespace detail

[[nodiscard]] inline CsgRegion csg_region(const CsgTree& tree) { return detail::CsgRegions(tree).run(); }

}  // namespace raycast
