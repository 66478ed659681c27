// SPDX-License-Identifier: MIT
#pragma once

// A walk in double precision along a line through a compiled scene. No box that the line meets is missed (box.hpp), and the heap is not
// touched.

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/compiled.hpp>
#include <raycast/kernels.hpp>
#include <raycast/ray.hpp>

namespace raycast {

// The objects of a compiled scene whose bounds the line may meet within [t0, limit], nearer ones first as far as it is cheap to know:
// visit(object) -> bool, until one returns true. visit may lower `limit`. Rooms are not among them, and an object of many shapes is
// visited once for its guard.
template <class Visit>
bool objects_along(const Compiled& scene, const Segment& line, double t0, const double& limit, Visit&& visit) {
  const auto leaf = [&](std::uint32_t at) {
    const Kind kind = leaf_kind(at);
    for (std::uint32_t j = 0; j < leaf_count(at); ++j) {
      const std::uint32_t object = scene.object_of(shape_id(kind, leaf_first(at) + j));
      const bool by_guard = (kind == Kind::triangle || kind == Kind::quad) && scene.roles[object] != Role::polygon;
      if (!by_guard && visit(object)) return true;
    }
    return false;
  };
  if (scene.nodes.empty()) return false;
  struct Entry {
    std::uint32_t child;
    double t;
  };
  const SlabTest slabs(Segment{scene.local(line.origin), line.direction * scene.scale});
  Entry stack[stack_size];
  std::size_t top = 0;
  stack[top++] = {0, t0};
  while (top > 0) {
    const Entry at = stack[--top];
    if (at.t > limit) continue;
    if (is_leaf(at.child)) {
      if (leaf(at.child)) return true;
      continue;
    }
    const Node& node = scene.nodes[at.child];
    const std::size_t first = top;
    for (std::size_t i = 0; i < 8; ++i) {
      const Box box{{node.bound[0][i], node.bound[1][i], node.bound[2][i]}, {node.bound[3][i], node.bound[4][i], node.bound[5][i]}};
      Entry entry{node.child[i], 0.0};
      if (box.empty() || !slabs(box, t0, limit, entry.t)) continue;
      std::size_t place = top++;
      for (; place > first && stack[place - 1].t < entry.t; --place) stack[place] = stack[place - 1];
      stack[place] = entry;
    }
  }
  return false;
}

}  // namespace raycast
