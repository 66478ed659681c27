// SPDX-License-Identifier: MIT
#pragma once

// Searches along a line in double precision, through a Bvh and through a compiled scene. The caller passes a lambda that handles the
// items of leaves. No box that the line meets is missed (box.hpp).

#include <cstddef>
#include <cstdint>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/compiled.hpp>
#include <raycast/ray.hpp>
#include <raycast/walk.hpp>

namespace raycast {

// Calls visit(item) -> bool for the items whose leaf the line meets within [t0, t1], in no particular order, until one returns true.
template <class Visit>
[[nodiscard]] bool any_along(const Bvh& bvh, const SlabTest& slabs, double t0, double t1, Visit&& visit) {
  if (bvh.empty()) { return false; }
  struct Open {
    std::uint32_t child;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  double entry = 0.0;
  const auto leaf = [&](const Open& at) {
    for (const std::uint32_t item : bvh.items(nodes[at.child])) {
      if (visit(item)) { return true; }
    }
    return false;
  };
  const auto inner = [&](const Open& at, auto& put_off) {
    const std::uint32_t first = nodes[at.child].first;
    if (slabs(nodes[first + 1].box, t0, t1, entry)) { put_off.push({first + 1}); }
    if (slabs(nodes[first].box, t0, t1, entry)) {
      put_off.push({first});  // the larger one is visited next
    }
    return false;
  };
  return slabs(nodes[0].box, t0, t1, entry) && portable::walk(bvh, Open{0}, everything, leaf, inner);
}

// Calls visit(item) for the items whose leaf the line meets within [t0, limit], nearer leaves first. visit may lower `limit`; what lies
// beyond it is skipped.
template <class Visit>
void nearest_along(const Bvh& bvh, const SlabTest& slabs, double t0, const double& limit, Visit&& visit) {
  if (bvh.empty()) { return; }
  struct Open {
    std::uint32_t child;
    double at;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  const auto near = [&](const Open& open) { return !(open.at > limit); };
  const auto leaf = [&](const Open& open) {
    for (const std::uint32_t item : bvh.items(nodes[open.child])) { visit(item); }
    return false;
  };
  const auto inner = [&](const Open& open, auto& put_off) {
    const std::size_t bottom = put_off.size();
    for (const std::uint32_t child : {nodes[open.child].first, nodes[open.child].first + 1}) {
      double entry = 0.0;
      if (slabs(nodes[child].box, t0, limit, entry)) { put_off.push_sorted(bottom, Open{child, entry}); }
    }
    return false;
  };
  static_cast<void>(portable::walk(bvh, Open{0, t0}, near, leaf, inner));
}

// Calls visit(object) -> bool for the objects of a compiled scene whose bounds the line may meet within [t0, limit], until one returns
// true; nearer ones first, as far as that is cheap to determine. visit may lower `limit`. Rooms are not included, and an object of many
// shapes is visited once, for its guard.
template <class Visit>
bool objects_along(const Compiled& scene, const Segment& line, double t0, const double& limit, Visit&& visit) {
  if (scene.nodes.empty()) { return false; }
  struct Open {
    std::uint32_t child;
    double at;
  };
  const SlabTest slabs(Segment{scene.local(line.origin), line.direction * scene.scale});
  const auto near = [&](const Open& at) { return !(at.at > limit); };
  const auto leaf = [&](const Open& at) {
    const Kind kind = leaf_kind(at.child);
    for (std::uint32_t j = 0; j < leaf_count(at.child); ++j) {
      const std::uint32_t object = scene.object_of(shape_id(kind, leaf_first(at.child) + j));
      const bool by_guard = (kind == Kind::triangle || kind == Kind::quad) && scene.roles[object] != Role::polygon;
      if (!by_guard && visit(object)) { return true; }
    }
    return false;
  };
  const auto inner = [&](const Open& at, auto& put_off) {
    const Node& node = scene.nodes[at.child];
    const std::size_t bottom = put_off.size();
    for (std::size_t i = 0; i < 8; ++i) {
      const Box box{{node.bound[0][i], node.bound[1][i], node.bound[2][i]}, {node.bound[3][i], node.bound[4][i], node.bound[5][i]}};
      Open child{node.child[i], 0.0};
      if (!box.empty() && slabs(box, t0, limit, child.at)) { put_off.push_sorted(bottom, child); }
    }
    return false;
  };
  return portable::walk(scene, Open{0, t0}, near, leaf, inner);
}

}  // namespace raycast
