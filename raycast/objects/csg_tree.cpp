// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_tree.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

inline constexpr std::size_t max_csg_depth = 64;

HALFLIGHT_INLINE Made<CsgTree> CsgTree::make(const CsgNode& root) {
  const std::shared_ptr<CsgTree> tree(new CsgTree);
  if (std::string refusal = tree->take(root, {}, brep::invalid_index, true, false, 0); !refusal.empty()) { return refusal; }
  tree->bounds_ = tree->bounds_of(0);
  for (const Leaf& leaf : tree->leaves_) { tree->film_ = std::max(tree->film_, tol_film * leaf.solid.bounds().diameter()); }
  return std::shared_ptr<const CsgTree>(tree);
}

HALFLIGHT_INLINE CsgTree CsgTree::cut(const std::vector<Share>& shares, const std::shared_ptr<const Object>& box) const {
  CsgTree result = *this;
  const auto append = [&](std::uint32_t leaf, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(result.nodes_.size());
    result.nodes_[parent].parts.push_back(index);
    result.nodes_.push_back({CsgOperation::unite, {}, parent, result.nodes_[parent].parts.size() == 1, leaf});
  };
  const auto append_box = [&](std::uint32_t parent) {
    const auto leaf = static_cast<std::uint32_t>(result.leaves_.size());
    result.leaves_.push_back({PlacedObject(box), result.sheet_count(), false});
    for (std::uint32_t s = 0; s < box->sheet_count(); ++s) {
      result.leaf_of_sheet_.push_back(leaf);
      result.names_.emplace_back(box->sheet_name(s));
    }
    append(leaf, parent);
  };
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    if (!nodes_[n].parts.empty() || shares[nodes_[n].leaf] == Share::all) { continue; }
    const Share share = shares[nodes_[n].leaf];
    result.nodes_[n].operation = share == Share::none ? CsgOperation::subtract : CsgOperation::intersect;
    if (share == Share::within) { append(nodes_[n].leaf, n); }
    append_box(n);
    if (share == Share::none) { append_box(n); }
  }
  const auto root = static_cast<std::uint32_t>(result.nodes_.size());
  result.nodes_.push_back(result.nodes_[0]);
  result.nodes_[0] = {CsgOperation::intersect, {root}, brep::invalid_index, true, brep::invalid_index};
  append_box(0);
  return result;
}

HALFLIGHT_INLINE SurfacePoint CsgTree::project(std::uint32_t sheet, const glm::dvec3& p) const {
  const Leaf& leaf = leaves_[leaf_of_sheet_[sheet]];
  SurfacePoint result = leaf.solid.project(sheet - leaf.first_sheet, p);
  if (leaf.taken_away) { result.normal = -result.normal; }
  return result;
}

HALFLIGHT_INLINE glm::dvec3 CsgTree::vertex(std::uint32_t sheet, const glm::dvec3& p) const {
  const Leaf& leaf = leaves_[leaf_of_sheet_[sheet]];
  return leaf.solid.vertex(sheet - leaf.first_sheet, p);
}

HALFLIGHT_INLINE double CsgTree::work() const {
  double sum = 0.0;
  for (const Leaf& leaf : leaves_) { sum += leaf.solid.object().work(); }
  return 2.0 * sum;  // merging takes as long as the leaves themselves
}

HALFLIGHT_INLINE bool CsgTree::convex() const {
  return std::all_of(nodes_.begin(), nodes_.end(),
                     [](const Node& n) { return n.parts.size() <= 1 || n.operation == CsgOperation::intersect; }) &&
         std::all_of(leaves_.begin(), leaves_.end(), [](const Leaf& leaf) { return leaf.solid.convex(); });
}

HALFLIGHT_INLINE void CsgTree::spans(const Segment& line, Spans& out) const {
  InlineVector<Event, 32> events;
  const SlabTest slabs(line);
  for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
    double entry = 0.0;
    if (!slabs(leaves_[i].solid.bounds(), -infinity, infinity, entry)) { continue; }
    Spans own;
    leaves_[i].solid.spans(line, own);
    for (const Span& span : own) {
      events.push({span.in, i, true});
      events.push({span.out, i, false});
    }
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    if (a.at.t != b.at.t) { return a.at.t < b.at.t; }
    return a.leaf != b.leaf ? a.leaf < b.leaf : a.enters && !b.enters;
  });
  State state(*this);
  Crossing in{0.0, no_crossing_sheet};
  for (std::size_t i = 0; i < events.size();) {
    std::size_t end = i + 1;
    while (end < events.size() && coincide(line, &events[i], &events[end])) { ++end; }
    const bool was_inside = state.inside();
    std::uint32_t leaf = events[i].leaf;
    if (end - i == 1) {
      state.turn(leaf);
    } else {
      const State before = state;
      for (std::size_t k = i; k < end; ++k) { state.turn(events[k].leaf); }
      if (state.inside() != was_inside) { leaf = state.cause(before); }
    }
    if (state.inside() != was_inside) {
      std::size_t k = i;
      while (events[k].leaf != leaf) { ++k; }
      const Crossing at{events[k].at.t, leaves_[leaf].first_sheet + events[k].at.sheet};
      if (was_inside) {
        out.push(Span{in, at});
      } else {
        in = at;
      }
    }
    i = end;
  }
}

HALFLIGHT_INLINE bool CsgTree::contains(const glm::dvec3& p) const {
  Spans through;
  spans(Segment{p, glm::dvec3(0.6, 0.64, 0.48)}, through);
  return std::any_of(through.begin(), through.end(), [](const Span& s) { return s.in.t < 0.0 && s.out.t > 0.0; });
}

HALFLIGHT_INLINE CsgTree::State::State(const CsgTree& tree) : tree_(&tree) {
  for (std::uint32_t n = 0; n < tree.nodes_.size(); ++n) {
    nodes_.push(Value{0, false, false});
    if (tree.nodes_[n].parts.empty()) { leaf_node_.push(n); }
  }
}

HALFLIGHT_INLINE void CsgTree::State::turn(std::uint32_t leaf) {
  std::uint32_t n = leaf_node_[leaf];
  nodes_[n].inside = !nodes_[n].inside;
  while (n != 0) {
    const bool part_inside = nodes_[n].inside, first = tree_->nodes_[n].first;
    n = tree_->nodes_[n].parent;
    const Node& node = tree_->nodes_[n];
    Value& value = nodes_[n];
    if (first) {
      value.first = part_inside;
    } else {
      value.others = part_inside ? value.others + 1 : value.others - 1;
    }
    bool now = value.first && value.others == 0;
    if (node.operation == CsgOperation::unite) { now = value.first || value.others > 0; }
    if (node.operation == CsgOperation::intersect) { now = value.first && value.others + 1 == node.parts.size(); }
    if (now == value.inside) { return; }
    value.inside = now;
  }
}

HALFLIGHT_INLINE std::uint32_t CsgTree::State::cause(const State& before) const {
  std::uint32_t n = 0;
  while (!tree_->nodes_[n].parts.empty()) {
    for (const std::uint32_t part : tree_->nodes_[n].parts) {
      if (nodes_[part].inside != before.nodes_[part].inside) {
        n = part;
        break;
      }
    }
  }
  return tree_->nodes_[n].leaf;
}

HALFLIGHT_INLINE bool CsgTree::coincide(const Segment& line, const Event* first, const Event* last) const {
  const double dt = last->at.t - first->at.t;
  if (dt != 0.0) {
    const auto depth = [&](const Event& e) {
      return dt * std::abs(glm::dot(leaves_[e.leaf].solid.project(e.at.sheet, line.at(e.at.t)).normal, line.direction));
    };
    if (!(dt * glm::length(line.direction) <= film_reach * film_) || depth(*first) > film_ || depth(*last) > film_) { return false; }
  }
  return std::none_of(first, last, [&](const Event& e) { return e.leaf == last->leaf; });
}

HALFLIGHT_INLINE std::string CsgTree::take(const CsgNode& given, const Placement& outer, std::uint32_t parent, bool first, bool taken_away,
                                           std::size_t depth) {
  const std::string who = given.name.empty() ? "a part of the solid" : "'" + given.name + "'";
  if (depth == max_csg_depth) { return "unions, intersections and differences are nested deeper than " + std::to_string(max_csg_depth); }
  if (given.placement.inside) { return who + " is turned inside out: operands are solids, turn what is made of them"; }
  const Placement placement = compose(outer, given.placement);
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({given.operation, {}, parent, first, brep::invalid_index});
  if (!given.solid) {
    if (given.parts.empty()) { return who + " has no parts"; }
    for (std::size_t i = 0; i < given.parts.size(); ++i) {
      nodes_[index].parts.push_back(static_cast<std::uint32_t>(nodes_.size()));
      const bool away = given.operation == CsgOperation::subtract && i > 0;
      if (std::string refusal = take(given.parts[i], placement, index, i == 0, taken_away != away, depth + 1); !refusal.empty()) {
        return refusal;
      }
    }
    return {};
  }
  if (!given.solid->solid()) { return who + " has no inside: only solids can be united, intersected or taken away"; }
  if (std::optional<std::string> fault = check(*given.solid, placement)) { return who + ": " + *fault; }
  nodes_[index].leaf = static_cast<std::uint32_t>(leaves_.size());
  leaves_.push_back({PlacedObject(given.solid, placement), sheet_count(), taken_away});
  for (std::uint32_t s = 0; s < given.solid->sheet_count(); ++s) {
    leaf_of_sheet_.push_back(nodes_[index].leaf);
    const std::string own(given.solid->sheet_name(s));
    names_.push_back(given.solid->sheet_count() == 1 && !given.name.empty() ? given.name
                     : given.name.empty()                                   ? own
                                                                            : given.name + "." + own);
  }
  return {};
}

HALFLIGHT_INLINE Box CsgTree::bounds_of(std::uint32_t index) const {
  const Node& node = nodes_[index];
  if (node.parts.empty()) { return leaves_[node.leaf].solid.bounds(); }
  Box box = bounds_of(node.parts[0]);
  if (node.operation == CsgOperation::subtract) { return box; }
  for (std::size_t i = 1; i < node.parts.size(); ++i) {
    const Box part = bounds_of(node.parts[i]);
    if (node.operation == CsgOperation::unite) {
      box.extend(part);
    } else {
      box.lo = glm::max(box.lo, part.lo);
      box.hi = glm::min(box.hi, part.hi);
    }
  }
  return box;
}

}  // namespace raycast
